#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QTimer>
#include <cmath>

#include "core/scene/interlock_builder.hpp"
#include "core/scene/model_builder.hpp"
#include "ui/panels/cell_family.hpp"
#include "ui/panels/cell_panel.hpp"
#include "ui/panels/cell_parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/value_field.hpp"

using namespace pliant;
using panels::CellPanel;
using panels::CellParameterRow;

namespace {

constexpr int patience = 60'000;  // milliseconds

document::LoadedScene sceneOf(const std::string& type) {
  for (const auto& family : panels::cellFamilies())
    if (family.type == type) {
      scene::Scene scene = scene::Scene::parse(panels::sceneOfFamily(family).dump(), ".", type);
      auto model = scene::buildModel(scene);
      return {std::move(scene), std::move(model)};
    }
  throw std::runtime_error("no such family");
}

}  // namespace

class TestCellPanel : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    document_ = std::make_unique<document::Document>();
    panel_ = std::make_unique<CellPanel>(*document_);
    connect(document_.get(), &document::Document::messageRaised, this,
            [this](base::Severity, const QString& sentence) { messages_ << sentence; });
    messages_.clear();
    panel_->resize(320, 700);
    panel_->show();
  }
  void cleanup() {
    panel_.reset();
    document_.reset();
  }

  void everyFamilyMakesASoundScene() {
    QVERIFY(panels::cellFamilies().size() >= 6);
    for (const auto& family : panels::cellFamilies()) {
      QVERIFY(!family.title.isEmpty() && family.sentence.endsWith('.'));
      document_->adopt(sceneOf(family.type), {});
      QCOMPARE(document_->studies().size(), std::size_t(4));
      QTRY_VERIFY_WITH_TIMEOUT(panel_->findings().contains("Linked as it should be"), patience);
      QTRY_VERIFY_WITH_TIMEOUT(panel_->findings().contains("wire radii"), patience);
    }
  }

  /// What is there to be set comes from the format: every number of the kind and nothing else.
  void rowsAreTheNumbersOfTheFormat() {
    document_->adopt(sceneOf("torus_knot"), {});
    for (const char* key : {"p", "q", "a", "b", "c", "wire_radius", "spacing"}) QVERIFY(panel_->row(key));
    QVERIFY(!panel_->row("tilt") && !panel_->row("name") && !panel_->row("supercell"));
    QCOMPARE(panel_->row("a")->field()->shownText(), QString("4.4 mm"));
    document_->adopt(sceneOf("four_in_one"), {});
    QCOMPARE(panel_->row("tilt")->field()->shownText(), QString("28 deg"));
    QVERIFY(!panel_->row("p"));
  }

  void aDragIsOneStepAndIsSeenMeanwhile() {
    document_->adopt(sceneOf("ring_net"), {});
    QTRY_VERIFY_WITH_TIMEOUT(!panel_->findings().trimmed().isEmpty(), patience);
    std::vector<double> spacings;
    connect(panel_.get(), &CellPanel::cellInspected, this, [&](const jobs::InspectedCell& cell, bool draft) {
      if (draft) spacings.push_back(cell.cell->lattice(0, 0));
    });
    CellParameterRow* row = panel_->row("spacing");
    const QPoint begin = row->slider()->handlePosition();
    QTest::mousePress(row->slider(), Qt::LeftButton, {}, begin);
    QTest::mouseMove(row->slider(), begin + QPoint(4, 0));
    QTRY_VERIFY_WITH_TIMEOUT(!spacings.empty(), patience);
    QVERIFY(spacings.back() > 12e-3);
    QVERIFY(document_->undoStack().count() == 0);
    QTest::mouseMove(row->slider(), begin + QPoint(7, 0));
    QTest::mouseRelease(row->slider(), Qt::LeftButton, {}, begin + QPoint(7, 0));
    QTRY_COMPARE_WITH_TIMEOUT(document_->undoStack().count(), 1, patience);
    const double spacing = document_->valueAt("/interlocking_cells/0/spacing").get<double>();
    QVERIFY(spacing > 12.1e-3 && spacing < 13.7e-3);
    document_->undoStack().undo();
    QCOMPARE(document_->valueAt("/interlocking_cells/0/spacing").get<double>(), 12e-3);
    QCOMPARE(row->field()->shownText(), QString("12 mm"));
    QVERIFY(messages_.isEmpty());
  }

  /// Keys come faster than inspections, and models take longer still: none is lost.
  void keysInARowAddUp() {
    document_->setBackground(
        [](document::BackgroundWork work) { QTimer::singleShot(40, [work = std::move(work)] { work()(); }); });
    document_->adopt(sceneOf("ring_net"), {});
    QTRY_VERIFY_WITH_TIMEOUT(!panel_->findings().trimmed().isEmpty(), patience);
    panels::ParameterSlider* slider = panel_->row("spacing")->slider();
    for (int i = 0; i < 6; ++i) {
      QTest::keyClick(slider, Qt::Key_Right, Qt::ShiftModifier);
      QTest::qWait(15);
    }
    const auto spacing = [this] { return document_->valueAt("/interlocking_cells/0/spacing").get<double>(); };
    // Six thousandths of the slider's length, which is from a fiftieth of twice the default to that.
    const double wanted = 12e-3 + 6 * 0.001 * 0.98 * 24e-3;
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(spacing() - wanted) < 6 * 0.5e-5, patience);
    QTRY_VERIFY_WITH_TIMEOUT(!document_->isEditing(), patience);
    QVERIFY(std::abs(spacing() - wanted) < 6 * 0.5e-5);
    QCOMPARE(document_->undoStack().count(), 1);
  }

  void whatDoesNotFitIsKeptAndSaid() {
    document_->adopt(sceneOf("ring_net"), {});
    type("spacing", "15 mm");
    QTRY_VERIFY_WITH_TIMEOUT(panel_->isRefused(), patience);
    QVERIFY(panel_->findings().contains("overlap by 0.7 mm"));
    QCOMPARE(messages_.size(), 1);
    QVERIFY(messages_[0].contains("overlap by 0.7 mm"));
    QCOMPARE(document_->undoStack().count(), 0);
    QCOMPARE(panel_->row("spacing")->field()->shownText(), QString("15 mm"));
    // Another number makes it fit, and both go into the scene as one step.
    type("ring_radius", "5 mm");
    QTRY_COMPARE_WITH_TIMEOUT(document_->undoStack().count(), 1, patience);
    QVERIFY(!panel_->isRefused());
    QVERIFY(std::abs(document_->valueAt("/interlocking_cells/0/spacing").get<double>() - 15e-3) < 1e-12);
    QVERIFY(std::abs(document_->valueAt("/interlocking_cells/0/ring_radius").get<double>() - 5e-3) < 1e-12);
    // And what does not fit is taken back.
    type("wire_radius", "3 mm");
    QTRY_VERIFY_WITH_TIMEOUT(panel_->isRefused(), patience);
    panel_->takeBack();
    QTRY_VERIFY_WITH_TIMEOUT(!panel_->isRefused(), patience);
    QCOMPARE(panel_->row("wire_radius")->field()->shownText(), QString("0.6 mm"));
  }

  void lostLinksAreNamed() {
    document_->adopt(sceneOf("ring_net"), {});
    type("spacing", "20 mm");
    QTRY_VERIFY_WITH_TIMEOUT(panel_->isRefused(), patience);
    QVERIFY2(panel_->findings().contains("are not linked, but should be"), qPrintable(panel_->findings()));
  }

  void textThatIsNoLengthIsRefused() {
    document_->adopt(sceneOf("threefold"), {});
    type("lean", "much");
    QTRY_COMPARE_WITH_TIMEOUT(messages_.size(), 1, patience);
    QCOMPARE(document_->undoStack().count(), 0);
  }

  /// What is typed beyond an end of a slider moves that end, to a round number; another scene has ends of its own.
  void typedValuesWidenTheSlider() {
    document_->adopt(sceneOf("ring_net"), {});
    const auto slider = [this](const char* key) { return panel_->row(key)->slider(); };
    const auto near = [](double value, double wanted) { return std::abs(value - wanted) < 1e-9; };
    QVERIFY(near(slider("spacing")->realMaximum(), 24e-3));
    type("spacing", "23 mm");
    QTRY_VERIFY_WITH_TIMEOUT(near(slider("spacing")->realValue(), 23e-3), patience);
    QVERIFY(near(slider("spacing")->realMaximum(), 24e-3));
    type("spacing", "30 mm");
    QTRY_VERIFY_WITH_TIMEOUT(near(slider("spacing")->realValue(), 30e-3), patience);
    QVERIFY(near(slider("spacing")->realMaximum(), 40e-3));
    const double low = slider("wire_radius")->realMinimum();
    QVERIFY(low > 0.02e-3);
    type("wire_radius", "0.02 mm");
    QTRY_VERIFY_WITH_TIMEOUT(near(slider("wire_radius")->realValue(), 0.02e-3), patience);
    QVERIFY(near(slider("wire_radius")->realMinimum(), 0.01e-3));
    document_->adopt(sceneOf("ring_net"), {});
    QVERIFY(near(slider("spacing")->realMaximum(), 24e-3));
    QVERIFY(near(slider("wire_radius")->realMinimum(), low));
  }

  void theSupercellIsSetToo() {
    document_->adopt(sceneOf("threefold"), {});
    const auto counts = panel_->findChildren<QSpinBox*>();
    QCOMPARE(counts.size(), 2);
    counts[0]->setValue(2);
    QTRY_COMPARE_WITH_TIMEOUT(document_->undoStack().count(), 1, patience);
    QCOMPARE(scene::buildCell(document_->scene(), "material").elements.size(), std::size_t(2));
  }

 private:
  void type(const std::string& key, const QString& text) {
    panels::ValueField* field = panel_->row(key)->field();
    QTest::mouseDClick(field, Qt::LeftButton);
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }

  std::unique_ptr<document::Document> document_;
  std::unique_ptr<CellPanel> panel_;
  QStringList messages_;
};

QTEST_MAIN(TestCellPanel)
#include "test_cell_panel.moc"
