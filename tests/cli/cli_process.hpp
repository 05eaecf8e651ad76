#pragma once

#include <QProcess>
#include <QStringList>

namespace pliant::test {

struct CliOutcome {
  int status = -1;  ///< exit status; -1 if the program crashed
  QString output;
  QString errors;
};

/// Runs build/bin/pliant-cli and waits for its end.
inline CliOutcome runCli(const QStringList& arguments, const QString& folder = {}) {
  QProcess process;
  if (!folder.isEmpty()) process.setWorkingDirectory(folder);
  process.start(PLIANT_CLI, arguments);
  process.waitForFinished(-1);
  CliOutcome outcome;
  outcome.status = process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1;
  outcome.output = QString::fromUtf8(process.readAllStandardOutput());
  outcome.errors = QString::fromUtf8(process.readAllStandardError());
  return outcome;
}

}  // namespace pliant::test
