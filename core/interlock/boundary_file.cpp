#include "core/interlock/boundary_file.hpp"

#include <cstdlib>
#include <sstream>

#include "core/base/error.hpp"

namespace pliant::interlock {

namespace {

constexpr const char* firstLine = "pliant boundary states 1";

std::string lineOf(const std::string& name, const BoundaryState& state) {
  std::ostringstream line;
  line << name << "; " << std::hexfloat << state.distance << ' ' << state.remaining << ' ' << state.meanGap << ' '
       << state.contacts << ' ' << state.iterations << ' ' << static_cast<int>(state.kind) << ' '
       << static_cast<int>(state.termination) << ' ' << state.raised << ' ' << state.seesBeyond << ' '
       << state.cell.rotations.size();
  for (Eigen::Index i = 0; i < 3; ++i) line << ' ' << state.cell.strain[i];
  for (Eigen::Index i = 0; i < state.cell.positions.size(); ++i) line << ' ' << state.cell.positions.data()[i];
  for (const Eigen::Matrix3d& rotation : state.cell.rotations)
    for (Eigen::Index i = 0; i < 9; ++i) line << ' ' << rotation.data()[i];
  line << " .";  // a line without its end was cut short
  return line.str();
}

bool readLine(const std::string& text, std::string& name, BoundaryState& state) {
  const std::size_t split = text.find("; ");
  if (split == std::string::npos) return false;
  name = text.substr(0, split);
  std::istringstream line(text.substr(split + 2));
  std::string word;
  const auto number = [&](double& value) {  // streams cannot read hexadecimal floats
    line >> word;
    value = std::strtod(word.c_str(), nullptr);
  };
  int kind = 0, termination = 0;
  std::size_t count = 0;
  number(state.distance);
  number(state.remaining);
  number(state.meanGap);
  line >> state.contacts >> state.iterations >> kind >> termination >> state.raised >> state.seesBeyond >> count;
  if (!line || count > 100'000) return false;
  state.kind = static_cast<RestKind>(kind);
  state.termination = static_cast<base::TerminationType>(termination);
  state.cell.positions.resize(3, static_cast<Eigen::Index>(count));
  state.cell.rotations.resize(count);
  for (Eigen::Index i = 0; i < 3; ++i) number(state.cell.strain[i]);
  for (Eigen::Index i = 0; i < state.cell.positions.size(); ++i) number(state.cell.positions.data()[i]);
  for (Eigen::Matrix3d& rotation : state.cell.rotations)
    for (Eigen::Index i = 0; i < 9; ++i) number(rotation.data()[i]);
  line >> word;
  return line && word == ".";
}

}  // namespace

bool KnownStates::read(const std::filesystem::path& file, const std::string& key) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) return false;
  if (line != firstLine)
    throw base::InputError(file.string(), "this file is there already and holds no states of a boundary");
  if (!std::getline(in, line) || line != key) return false;
  while (std::getline(in, line)) {
    std::string name;
    BoundaryState state;
    if (readLine(line, name, state)) states_[name] = state;
  }
  return true;
}

bool KnownStates::recall(const std::string& name, BoundaryState& state) {
  const std::lock_guard lock(mutex_);
  const auto found = states_.find(name);
  if (found == states_.end()) return false;
  state = found->second;
  return true;
}

void KnownStates::keep(const std::string& name, const BoundaryState& state) {
  const std::lock_guard lock(mutex_);
  states_[name] = state;
}

BoundaryFile::BoundaryFile(const std::filesystem::path& file, const std::string& key) {
  read(file, key);
  recalled_ = count();
  // Written anew, so that a line that was cut short does not spoil the next.
  out_.open(file, std::ios::trunc);
  out_ << firstLine << '\n' << key << '\n';
  for (const auto& [name, state] : states_) out_ << lineOf(name, state) << '\n';
  out_.flush();
  if (!out_) throw base::InputError(file.string(), "the file cannot be written");
}

void BoundaryFile::keep(const std::string& name, const BoundaryState& state) {
  KnownStates::keep(name, state);
  const std::string line = lineOf(name, state);
  const std::lock_guard lock(mutex_);
  out_ << line << '\n';
  out_.flush();
}

}  // namespace pliant::interlock
