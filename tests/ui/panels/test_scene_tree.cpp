#include <QComboBox>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>

#include "core/mechanics/model.hpp"
#include "ui/document/scene_entries.hpp"
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

  void everyKindOfEntryCanBeAddedAndUndone() {
    // Of every kind of entry of every list the default fits into the scene, or is refused with a sentence that says
    // what it lacks: an element needs triangles, a node is driven once.
    const auto before = document_->scene().json();
    for (const auto& field : scene::sceneSpec().fields) {
      for (const std::string& type : document::entryTypes(field.key)) {
        const auto count = document_->valueAt("/" + field.key).size();
        QSignalSpy raised(document_.get(), &document::Document::messageRaised);
        tree_->addEntry(field.key, type);
        if (raised.isEmpty()) {
          QCOMPARE(document_->valueAt("/" + field.key).size(), count + 1);
          QCOMPARE(tree_->currentIndex(), at("/" + field.key + "/" + std::to_string(count)));
          document_->undoStack().undo();
        } else {
          QVERIFY2(raised[0][1].toString().endsWith('.'), qPrintable(raised[0][1].toString()));
        }
        QVERIFY(document_->scene().json() == before);
      }
    }
  }

  void inAShellEveryMassDriveAndStudyCanBeAdded() {
    QVERIFY(document_->open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/fork.json")));
    tree_->setSelectedNode(40);
    QSignalSpy raised(document_.get(), &document::Document::messageRaised);
    for (const auto& [list, type] : std::vector<std::pair<std::string, std::string>>{{"point_masses", "point_mass"},
                                                                                     {"probes", "probe"},
                                                                                     {"drives", "translation"},
                                                                                     {"loads", "gravity"},
                                                                                     {"loads", "harmonic_force"},
                                                                                     {"springs", "between"},
                                                                                     {"springs", "grounded"},
                                                                                     {"springs", "anchored"},
                                                                                     {"boundary_conditions", "locked"},
                                                                                     {"studies", "periodic_motion"},
                                                                                     {"studies", "frequency_response"},
                                                                                     {"materials", "isotropic"},
                                                                                     {"geometry", "strip"}}) {
      tree_->addEntry(list, type);
      QVERIFY2(raised.isEmpty(), qPrintable(raised.isEmpty() ? QString() : raised[0][1].toString()));
      if (list == "geometry") {
        // What meant the only geometry names it now.
        QCOMPARE(document_->valueAt("/elements/0/geometry").get<std::string>(), std::string("fork"));
        QCOMPARE(document_->scene().json()["probes"][0]["at"]["geometry"].get<std::string>(), std::string("fork"));
      }
      if (list == "drives" || list == "boundary_conditions" || list == "geometry") document_->undoStack().undo();
    }
    // A mass sits on the selected node.
    QCOMPARE(document_->model()->pointMasses.back().nodes, std::vector<int>{40});
    QCOMPARE(document_->study("motion 2")->type, std::string("periodic_motion"));
  }

  void entriesAreDuplicatedAndRemovedByKeys() {
    QVERIFY(document_->open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/fork.json")));
    const auto before = document_->scene().json();
    tree_->setCurrentIndex(at("/point_masses/0"));
    tree_->expand(at("/drives").siblingAtColumn(0));
    QTest::keyClick(tree_.get(), Qt::Key_D, Qt::ControlModifier);
    QCOMPARE(document_->valueAt("/point_masses").size(), std::size_t(3));
    QCOMPARE(document_->valueAt("/point_masses/1/name").get<std::string>(), std::string("left tip 2"));
    QVERIFY(tree_->isExpanded(at("/drives").siblingAtColumn(0)));  // the tree stays as open as it was
    QTest::keyClick(tree_.get(), Qt::Key_Delete);
    QCOMPARE(document_->valueAt("/point_masses").size(), std::size_t(2));
    QVERIFY(document_->scene().json() == before);
    tree_->setCurrentIndex(at("/studies/1"));
    QTest::keyClick(tree_.get(), Qt::Key_Delete);
    QVERIFY(!document_->study("response"));
    QCOMPARE(document_->undoStack().undoText(), QString("Remove response"));
    for (int i = 0; i < 3; ++i) document_->undoStack().undo();
    QVERIFY(document_->scene().json() == before);
    // What something else needs cannot go.
    QSignalSpy raised(document_.get(), &document::Document::messageRaised);
    tree_->setCurrentIndex(at("/geometry/0"));
    QTest::keyClick(tree_.get(), Qt::Key_Delete);
    QCOMPARE(raised.count(), 1);
    QVERIFY(document_->scene().json() == before);
  }

  void thePlusAndInsertAdd() {
    const QModelIndex list = at("/probes");
    tree_->setCurrentIndex(list);
    QTest::keyClick(tree_.get(), Qt::Key_Insert);
    QCOMPARE(document_->valueAt("/probes").size(), std::size_t(2));
    const QRect line = tree_->visualRect(at("/point_masses"));
    QTest::mouseClick(tree_->viewport(), Qt::LeftButton, {}, QPoint(line.right() - 14, line.center().y()));
    QCOMPARE(document_->valueAt("/point_masses").size(), std::size_t(2));
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
