#include <QComboBox>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>

#include "ui/panels/scene_tree.hpp"

using namespace pliant;
using panels::SceneTree;

class TestSceneTree : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    document_ = std::make_unique<document::Document>();
    QVERIFY(document_->open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    tree_ = std::make_unique<SceneTree>(*document_);
    tree_->resize(320, 640);
    tree_->show();
  }

  void valuesAreEditedWithUnits() {
    QVERIFY(model().setData(at("/point_masses/0/mass"), "1200 g", Qt::EditRole));
    QCOMPARE(document_->valueAt("/point_masses/0/mass").get<double>(), 1.2);
    QCOMPARE(at("/point_masses/0/mass").data().toString(), QString("1200 g"));
    QVERIFY(model().setData(at("/point_masses/0/mass"), "900", Qt::EditRole));  // in the unit that is shown
    QCOMPARE(document_->valueAt("/point_masses/0/mass").get<double>(), 0.9);
    document_->undoStack().undo();
    QCOMPARE(at("/point_masses/0/mass").data().toString(), QString("1200 g"));
  }

  void refusedValuesStayOutWithASentence() {
    QSignalSpy raised(document_.get(), &document::Document::messageRaised);
    const QString before = at("/point_masses/0/mass").data().toString();
    for (const char* bad : {"-3 kg", "2 s", "nonsense"})
      QVERIFY(!model().setData(at("/point_masses/0/mass"), bad, Qt::EditRole));
    QCOMPARE(raised.count(), 3);
    QVERIFY(raised[0][1].toString().endsWith('.'));
    QCOMPARE(at("/point_masses/0/mass").data().toString(), before);
  }

  void optionalValuesThatAreMissingCanBeSet() {
    const QModelIndex maximum = at("/point_masses/0/maximum");
    QVERIFY(maximum.isValid());
    QVERIFY(model().setData(maximum, "3 kg", Qt::EditRole));
    QCOMPARE(document_->valueAt("/point_masses/0/maximum").get<double>(), 3.0);
  }

  void choicesAreLists() {
    const QModelIndex index = at("/mass_matrix");
    QVERIFY(index.isValid());
    tree_->setCurrentIndex(index);
    tree_->scrollTo(index);
    tree_->edit(index);
    auto* box = tree_->viewport()->findChild<QComboBox*>();
    QVERIFY(box);
    QCOMPARE(box->count(), 2);
  }

  void studiesTellTheirState() {
    const QModelIndex study = at("/studies/0");
    auto result = std::make_shared<scene::HarmonicResult>();
    result->termination = base::TerminationType::converged;
    document_->setResult("motion", result, document_->scene());
    QCOMPARE(study.data().toString(), QString("solved"));
    QVERIFY(document_->setValue("/point_masses/0/mass", "2 kg", "Mass"));
    QCOMPARE(at("/studies/0").data().toString(), QString("stale"));
  }

  void everyLineExplainsItself() {
    int lines = 0;
    const auto walk = [&](const auto& self, const panels::SceneItem& item) -> void {
      for (const auto& child : item.children) {
        if (child->editable) {
          ++lines;
          QVERIFY2(!model().indexOf(child->pointer).data(Qt::ToolTipRole).toString().isEmpty(), child->pointer.c_str());
        }
        self(self, *child);
      }
    };
    walk(walk, *model().itemAt({}));
    QVERIFY(lines > 20);
  }

 private:
  panels::SceneModel& model() { return tree_->sceneModel(); }
  QModelIndex at(const std::string& pointer) { return model().indexOf(pointer); }

  std::unique_ptr<document::Document> document_;
  std::unique_ptr<SceneTree> tree_;
};

QTEST_MAIN(TestSceneTree)
#include "test_scene_tree.moc"
