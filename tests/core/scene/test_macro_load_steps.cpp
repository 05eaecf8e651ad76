#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/scene/macro_reading.hpp"
#include "core/scene/macro_strains.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"
#include "tests/core/scene/strain_box.hpp"

using namespace pliant;

namespace {

constexpr const char* steppedScene = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "mail", "type": "threefold"}],
  "studies": [
    {"name": "pull", "type": "macro_equilibrium", "shape": "hexagon", "radius": "29 mm", "rings": 4,
     "stretch_limits": "box.obj", "gravity": [0, 0, "-2 m/s^2"], "native": true, "load_steps": 4,
     "clamps": [{"point": ["29 mm", 0]}, {"point": ["-29 mm", 0]}], "loads": [{"point": [0, 0], "force": [0, 0, "-0.4 N"]}]}
  ]
})";

}  // namespace

/// Loads that come in steps: every step is kept, of the sheet and of its elements.
class TestMacroLoadSteps : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::shared_ptr<const scene::MacroResult> stepped_;

  scene::Scene sceneOf(const std::vector<std::pair<std::string, std::string>>& changes = {}) const {
    std::string text = steppedScene;
    for (const auto& [what, with] : changes) {
      const std::size_t place = text.find(what);
      if (place == std::string::npos) qFatal("nothing to replace");
      text.replace(place, what.size(), with);
    }
    return scene::Scene::parse(text, folder_.path().toStdString(), "mail.json");
  }

  static std::shared_ptr<const scene::MacroResult> run(const scene::Scene& scene, int* handedOn = nullptr) {
    base::ExecutionContext context;
    const auto count = [&](const std::shared_ptr<const scene::Result>&) {
      if (handedOn) ++*handedOn;
    };
    return std::dynamic_pointer_cast<const scene::MacroResult>(
        scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "pull")->run(context, count));
  }

 private slots:
  void initTestCase() {
    writeText(folder_.filePath("box.obj"), strainBox);
    int handedOn = 0;
    stepped_ = run(sceneOf(), &handedOn);
    QVERIFY(stepped_->termination == base::TerminationType::converged);
    QCOMPARE(handedOn, 4);  // whoever watches sees each step
  }

  void keepsEveryStep() {
    QCOMPARE(stepped_->frames.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
      const scene::MacroFrame& frame = *stepped_->frames[i];
      QCOMPARE(frame.time, 0.25 * static_cast<double>(i));
      QVERIFY(frame.native && frame.native->rotations.size() == stepped_->native->patch->elements.size());
    }
    QVERIFY(stepped_->frames.front()->positions == stepped_->sheet->mesh.points);
    QVERIFY(stepped_->frames.back()->positions.reshaped() == stepped_->state.positions);
    QVERIFY(stepped_->frames.back()->native->positions == stepped_->native->rest.state.positions);
    QCOMPARE(stepped_->frames.back()->nativeDistance, stepped_->native->meanDistance);
  }

  /// At a step the sheet rests where it does under that part of the loads all at once.
  void stepsAreEquilibria() {
    const auto half = run(sceneOf({{"\"load_steps\": 4", "\"load_steps\": 1"},
                                   {"\"native\": true", "\"native\": false"},
                                   {"-2 m/s^2", "-1 m/s^2"},
                                   {"-0.4 N", "-0.2 N"}}));
    QVERIFY(half->frames.empty());
    const Eigen::VectorXd stepped = stepped_->frames[2]->positions.reshaped();
    const double moved = (half->state.positions - half->sheet->mesh.points.reshaped()).norm();
    qInfo("off by %.2g of the way", (stepped - half->state.positions).norm() / moved);
    QVERIFY((stepped - half->state.positions).norm() < 1e-3 * moved);
  }

  /// Of forces that do not change along the way: Σ force · way.
  void workIsThatOfAllLoads() {
    const Eigen::Matrix3Xd way =
        stepped_->state.positions.reshaped(3, stepped_->sheet->mesh.points.cols()) - stepped_->sheet->mesh.points;
    const interlock::MacroMaterial& material = stepped_->sheet->materials.front();
    double work = -0.4 * way(2, stepped_->loaded.at(0));
    for (const auto& [a, b, c] : stepped_->sheet->mesh.triangles) {
      const auto& places = stepped_->sheet->mesh.points;
      const Eigen::Vector3d u = places.col(b) - places.col(a), v = places.col(c) - places.col(a);
      const double mass = 0.5 * u.cross(v).norm() * material.density * material.thickness;
      work += -2 * mass * (way(2, a) + way(2, b) + way(2, c)) / 3;
    }
    QVERIFY(std::abs(stepped_->state.work / work - 1) < 1e-9);
  }

  void isReadFromItsFolder() {
    const auto place = (folder_.path() + "/result").toStdString();
    stepped_->write(place);
    const auto read = scene::readMacro(sceneOf(), place);
    QCOMPARE(read->frames.size(), stepped_->frames.size());
    for (std::size_t i = 0; i < read->frames.size(); ++i) {
      QCOMPARE(read->frames[i]->time, stepped_->frames[i]->time);
      QVERIFY(read->frames[i]->positions == stepped_->frames[i]->positions);
      QVERIFY(read->frames[i]->native->positions == stepped_->frames[i]->native->positions);
      QVERIFY(read->frames[i]->native->rotations == stepped_->frames[i]->native->rotations);
      QCOMPARE(read->frames[i]->nativeDistance, stepped_->frames[i]->nativeDistance);
    }
    QVERIFY(read->native->patch && read->native->rest.state.rotations == stepped_->native->rest.state.rotations);
  }
};

QTEST_GUILESS_MAIN(TestMacroLoadSteps)
#include "test_macro_load_steps.moc"
