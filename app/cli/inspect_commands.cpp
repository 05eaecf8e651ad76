#include <iostream>

#include "app/cli/commands.hpp"
#include "core/scene/format_tables.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"

namespace pliant::cli {

ExitStatus list(const std::string& file) {
  const auto scene = scene::Scene::load(file);
  const auto model = scene::buildModel(scene);
  const scene::Json& studies = scene.normalized()["studies"];
  std::cout << (studies.empty() ? "No studies\n" : "Studies\n");
  for (const scene::Json& study : studies)
    std::cout << "  " << study["name"].get<std::string>() << "  (" << study["type"].get<std::string>() << ")\n";
  std::cout << (model->parameters.empty() ? "No parameters\n" : "Parameters\n");
  for (const auto& parameter : model->parameters) {
    const auto show = [&](double value) { return base::formatQuantity(value, parameter->dimension()); };
    std::cout << "  " << parameter->name() << "  " << parameter->pointer() << "  " << show(parameter->value(*model))
              << "  (" << show(parameter->minimum(*model)) << " to " << show(parameter->maximum(*model)) << ")\n";
  }
  return done;
}

ExitStatus validate(const std::string& file) {
  const auto scene = scene::Scene::load(file);
  const auto model = scene::buildModel(scene);
  const std::vector<std::string> studies = scene::studyNames(scene);
  for (const std::string& name : studies) scene::StudyRegistry::instance().make(scene, model, name);
  std::cout << file << ": valid; " << model->nodeCount() << " nodes, "
            << scene::surfaceAt(*model, model->restPositions).triangles.size() << " triangles, "
            << model->dofs.freeCount() << " free coordinates, " << model->parameters.size() << " parameters, "
            << studies.size() << " studies\n";
  return done;
}

ExitStatus schema(bool tables) {
  std::cout << (tables ? scene::formatTables() : scene::formatJson(scene::jsonSchema()));
  return done;
}

}  // namespace pliant::cli
