#include <QDir>
#include <QElapsedTimer>
#include <QPushButton>
#include <QTest>
#include <QUndoStack>
#include <cmath>
#include <iostream>

#include "core/scene/element_design_result.hpp"
#include "core/scene/model_builder.hpp"
#include "ui/jobs/study_runner.hpp"
#include "ui/panels/boundary_panel.hpp"
#include "ui/panels/boundary_predictor.hpp"
#include "ui/panels/cell_panel.hpp"
#include "ui/panels/cell_parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/travel_panel.hpp"
#include "ui/plots/polar_plot.hpp"

using namespace pliant;
using document::StudyStatus;

namespace {

constexpr int patience = 120'000;  // milliseconds

constexpr const char* designScene = R"({
  "schema_version": 1,
  "title": "Design",
  "interlocking_cells": [{"name": "net", "type": "threefold"}],
  "studies": [
    {"name": "boundary", "type": "stretch_boundary", "subdivisions": 1, "test_star_shape": false},
    {"name": "ten per cent", "type": "element_design", "tolerance": 1e-4,
     "parameters": [{"name": "ring_radius"}, {"name": "distance"}, {"name": "lean"}],
     "polar_limits": [{"direction": "0 deg", "stretch": 0.1}, {"direction": "30 deg", "stretch": 0.1},
                      {"direction": "60 deg", "stretch": 0.1}, {"direction": "90 deg", "stretch": 0.1},
                      {"direction": "120 deg", "stretch": 0.1}, {"direction": "150 deg", "stretch": 0.1}]}
  ]
})";

}  // namespace

class TestElementDesignPanels : public QObject {
  Q_OBJECT

  std::unique_ptr<document::Document> document_;
  std::unique_ptr<jobs::JobRunner> jobs_, quick_;
  std::unique_ptr<jobs::StudyRunner> runner_;

  void run(const char* study) {
    runner_->run({study});
    QTRY_VERIFY_WITH_TIMEOUT(document_->study(study)->status == StudyStatus::solved, patience);
  }
  /// A picture to look at, where it is asked for.
  static void keepPicture(QWidget& widget, const char* name) {
    if (const QByteArray folder = qgetenv("PLIANT_TEST_PICTURES"); !folder.isEmpty())
      widget.grab().save(QDir(QString::fromLocal8Bit(folder)).filePath(QLatin1String(name)));
  }

 private Q_SLOTS:
  void init() {
    document_ = std::make_unique<document::Document>();
    jobs_ = std::make_unique<jobs::JobRunner>();
    quick_ = std::make_unique<jobs::JobRunner>();
    runner_ = std::make_unique<jobs::StudyRunner>(*document_, *jobs_);
  }
  void cleanup() {
    runner_.reset();
    quick_.reset();
    jobs_.reset();
    document_.reset();
  }

  /// The boundary of a dragged slider is there before anything is solved, and near what is solved then.
  void aSliderPredictsTheBoundary() {
    panels::CellPanel cell(*document_);
    panels::BoundaryPanel boundary(*document_, *quick_);
    const panels::BoundaryPredictor predictor(*document_, cell, boundary);
    cell.resize(320, 700);
    cell.show();
    boundary.resize(900, 500);
    boundary.show();
    scene::Scene scene = scene::Scene::parse(designScene, ".", "design");
    auto model = scene::buildModel(scene);
    document_->adopt({std::move(scene), std::move(model)}, {});
    run("boundary");
    QTRY_VERIFY_WITH_TIMEOUT(predictor.prediction() != nullptr, patience);
    QVERIFY(predictor.prediction()->smoothCount() >= 38);
    QVERIFY(!boundary.predicted());
    const Eigen::Matrix3Xd before = boundary.surface()->points;

    panels::ParameterSlider* slider = cell.row("ring_radius")->slider();
    const QPoint begin = slider->handlePosition(), end = begin + QPoint(3, 0);
    QTest::mousePress(slider, Qt::LeftButton, {}, begin);
    QTest::mouseMove(slider, end);
    QTRY_VERIFY_WITH_TIMEOUT(boundary.predicted() != nullptr, patience);
    QTest::mouseRelease(slider, Qt::LeftButton, {}, end);
    QTRY_VERIFY_WITH_TIMEOUT(document_->study("boundary")->stale, patience);
    QTRY_VERIFY(boundary.predicted() != nullptr);
    const Eigen::Matrix3Xd predicted = boundary.predicted()->points;
    QCOMPARE(boundary.surface()->points, before);
    keepPicture(boundary, "predicted.png");
    QElapsedTimer timer;
    timer.start();
    const auto again = predictor.prediction()->predict(document_->scene().normalized()["interlocking_cells"][0]);
    QVERIFY(again != nullptr);
    const auto surface = scene::boundarySurface(*again, "again");
    std::cout << "  a predicted surface of " << surface.knownCount() << " limits takes "
              << static_cast<double>(timer.nsecsElapsed()) * 1e-6 << " ms" << std::endl;
    QVERIFY(surface.points.isApprox(predicted, 1e-12));

    run("boundary");
    QTRY_VERIFY_WITH_TIMEOUT(!boundary.predicted(), patience);
    // Its middle, and with it the rays, have moved: extents compare.
    const Eigen::Matrix3Xd solved = boundary.surface()->points;
    for (int axis = 0; axis < 3; ++axis) {
      const double was = before.row(axis).maxCoeff(), is = solved.row(axis).maxCoeff();
      QVERIFY(is > was + 1e-4);
      QVERIFY2(std::abs(predicted.row(axis).maxCoeff() - is) < 0.3 * (is - was),
               qPrintable(QString("%1 %2 %3").arg(was).arg(predicted.row(axis).maxCoeff()).arg(is)));
    }
    // What was solved is the start of what is predicted next; undone, the first one is.
    QTRY_VERIFY_WITH_TIMEOUT(predictor.prediction() != nullptr, patience);
  }

  void aDesignIsSeenAndTaken() {
    panels::TravelPanel travel(*document_);
    travel.resize(900, 500);
    travel.show();
    scene::Scene scene = scene::Scene::parse(designScene, ".", "design");
    auto model = scene::buildModel(scene);
    document_->adopt({std::move(scene), std::move(model)}, {});
    QVERIFY(travel.shows("element_design") && !travel.take()->isVisible());
    run("ten per cent");
    QTRY_VERIFY(travel.take()->isVisible() && travel.take()->isEnabled());
    QCOMPARE(travel.plot()->curves().curves.size(), std::size_t{3});
    QVERIFY2(travel.summary().contains("the limits wanted are reached") && travel.summary().contains("ring radius 4.8"),
             qPrintable(travel.summary()));
    keepPicture(travel, "design.png");
    const auto result =
        std::dynamic_pointer_cast<const scene::ElementDesignStudyResult>(document_->study("ten per cent")->result);
    const auto radius = [&] {
      return document_->scene().normalized()["interlocking_cells"][0]["ring_radius"].get<double>();
    };
    travel.take()->click();
    QTRY_COMPARE(radius(), result->design.best().values[0]);
    document_->undoStack().undo();
    QTRY_COMPARE(radius(), 4.8e-3);
  }
};

QTEST_MAIN(TestElementDesignPanels)
#include "test_element_design_panels.moc"
