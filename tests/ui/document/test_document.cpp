#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include "core/mechanics/design_parameter.hpp"
#include "ui/document/document.hpp"
#include "ui/document/recent_files.hpp"

using namespace pliant;
using document::Document;

namespace {

const QString duffing = QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json");
const std::string mass = "/point_masses/0/mass";

std::shared_ptr<scene::HarmonicResult> resultThatIs(base::TerminationType termination) {
  auto result = std::make_shared<scene::HarmonicResult>();
  result->termination = termination;
  return result;
}

}  // namespace

class TestDocument : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init();
  void anEditCanBeUndoneAndRedone();
  void aRefusedEditChangesNothing();
  void editsWithOneMergeIdAreOneStep();
  void mergedEditsThatComeBackLeaveNoStep();
  void editsMakeResultsStaleAndUndoMakesThemFresh();
  void editsOfOneStudyLeaveOthersFresh();
  void titlesMakeNothingStale();
  void cancelledAndFailedStayMarked();
  void theModelFollowsTheScene();
  void editsThatNeedAModelAreBuiltInTheBackgroundOnce();
  void laterEditsWaitBehindOneThatIsBuilt();
  void waitingEditsCanBeDropped();
  void badFilesLeaveTheDocument();
  void savingCleansAndCanBeReadBack();
  void recentFilesAreNewestFirst();

 private:
  QString status(const char* study) { return document::toString(document_->study(study)->status); }

  std::unique_ptr<Document> document_;
};

void TestDocument::init() {
  document_ = std::make_unique<Document>();
  QVERIFY(document_->open(duffing));
}

void TestDocument::anEditCanBeUndoneAndRedone() {
  const auto before = document_->scene().json();
  QVERIFY(document_->setValue(mass, "1.5 kg", "Mass"));
  QCOMPARE(document_->valueAt(mass).get<double>(), 1.5);
  QVERIFY(document_->isModified());
  document_->undoStack().undo();
  QVERIFY(document_->scene().json() == before);
  QVERIFY(!document_->isModified());
  document_->undoStack().redo();
  QCOMPARE(document_->valueAt(mass).get<double>(), 1.5);
}

void TestDocument::aRefusedEditChangesNothing() {
  QSignalSpy raised(document_.get(), &Document::messageRaised);
  const auto before = document_->scene().json();
  for (const auto& bad :
       {document::Json("-1 kg"), document::Json("12 m"), document::Json("heavy"), document::Json(true)}) {
    QVERIFY(!document_->setValue(mass, bad, "Mass"));
    QVERIFY(document_->scene().json() == before);
    QVERIFY(!document_->undoStack().canUndo());
  }
  QCOMPARE(raised.count(), 4);
  QVERIFY(raised[0][1].toString().contains(QString::fromStdString(mass)));
}

void TestDocument::editsWithOneMergeIdAreOneStep() {
  for (const char* value : {"1.1 kg", "1.2 kg", "1.3 kg"}) QVERIFY(document_->setValue(mass, value, "Mass", 7));
  QCOMPARE(document_->undoStack().count(), 1);
  QVERIFY(document_->setValue(mass, "1.4 kg", "Mass", 8));
  QVERIFY(document_->setValue("/damping/mass_proportional", 0.1, "Damping", 8));
  QCOMPARE(document_->undoStack().count(), 3);
  document_->undoStack().undo();
  document_->undoStack().undo();
  QCOMPARE(document_->valueAt(mass).get<double>(), 1.3);
  document_->undoStack().undo();
  QCOMPARE(document_->valueAt(mass).get<double>(), 1.0);
}

void TestDocument::mergedEditsThatComeBackLeaveNoStep() {
  QVERIFY(document_->setValue(mass, "1.1 kg", "Mass", 7));
  QVERIFY(document_->setValue(mass, "1 kg", "Mass", 7));
  QCOMPARE(document_->undoStack().count(), 0);
  QVERIFY(!document_->isModified());
}

void TestDocument::editsMakeResultsStaleAndUndoMakesThemFresh() {
  document_->setResult("motion", resultThatIs(base::TerminationType::converged), document_->scene());
  QCOMPARE(status("motion"), QString("solved"));
  QVERIFY(document_->setValue(mass, "1.5 kg", "Mass"));
  QCOMPARE(status("motion"), QString("stale"));
  document_->undoStack().undo();
  QCOMPARE(status("motion"), QString("solved"));
  document_->undoStack().redo();
  QCOMPARE(status("motion"), QString("stale"));
  // Typing the old value is as good as undoing.
  QVERIFY(document_->setValue(mass, "1000 g", "Mass"));
  QCOMPARE(status("motion"), QString("solved"));
}

void TestDocument::editsOfOneStudyLeaveOthersFresh() {
  for (const char* name : {"motion", "response"})
    document_->setResult(name, resultThatIs(base::TerminationType::converged), document_->scene());
  QVERIFY(document_->setValue("/studies/0/frequency", "1.3 rad/s", "Frequency"));
  QCOMPARE(status("motion"), QString("stale"));
  QCOMPARE(status("response"), QString("solved"));
}

void TestDocument::titlesMakeNothingStale() {
  document_->setResult("motion", resultThatIs(base::TerminationType::converged), document_->scene());
  QVERIFY(document_->setValue("/title", "Another title", "Title"));
  QCOMPARE(document_->title(), QString("Another title"));
  QCOMPARE(status("motion"), QString("solved"));
}

void TestDocument::cancelledAndFailedStayMarked() {
  document_->setResult("motion", resultThatIs(base::TerminationType::cancelled), document_->scene());
  document_->setResult("response", resultThatIs(base::TerminationType::failed), document_->scene());
  QCOMPARE(status("motion"), QString("cancelled"));
  QCOMPARE(status("response"), QString("failed"));
  QVERIFY(document_->setValue(mass, "1.5 kg", "Mass"));
  QCOMPARE(status("motion"), QString("cancelled"));
  QVERIFY(document_->study("motion")->stale);
}

void TestDocument::theModelFollowsTheScene() {
  const auto valueOf = [](const mechanics::Model& model) { return model.parameters.front()->value(model); };
  QVERIFY(document_->setValue(mass, "1.5 kg", "Mass"));
  QCOMPARE(valueOf(*document_->model()), 1.5);
  QCOMPARE(document_->model()->massMatrix().coeff(0, 0), 1.5);
  document_->undoStack().undo();
  QCOMPARE(document_->model()->massMatrix().coeff(0, 0), 1.0);
  QVERIFY(document_->setValue("/damping/mass_proportional", 0.5, "Damping"));
  QCOMPARE(document_->model()->massDamping, 0.5);
}

/// Keeps the work, so that the test says when it runs and when it is delivered.
struct HeldWork {
  std::vector<document::BackgroundWork> work;
  void runAll() {
    while (!work.empty()) {
      const auto first = work.front();
      work.erase(work.begin());
      first()();
    }
  }
};

void TestDocument::editsThatNeedAModelAreBuiltInTheBackgroundOnce() {
  HeldWork held;
  int count = 0;
  document_->setBackground([&](document::BackgroundWork work) {
    ++count;
    held.work.push_back(std::move(work));
  });
  QSignalSpy editing(document_.get(), &Document::editingChanged);
  const auto before = document_->model();
  QVERIFY(document_->setValue("/damping/mass_proportional", 0.5, "Damping"));
  // Scene and model stay together until the new model is there.
  QVERIFY(document_->isEditing());
  QCOMPARE(document_->model(), before);
  QCOMPARE(document_->undoStack().count(), 0);
  held.runAll();
  QVERIFY(!document_->isEditing());
  QCOMPARE(document_->valueAt("/damping/mass_proportional").get<double>(), 0.5);
  QCOMPARE(document_->model()->massDamping, 0.5);
  QCOMPARE(editing.count(), 2);
  // Undo and redo have both models at hand.
  const auto after = document_->model();
  document_->undoStack().undo();
  QCOMPARE(document_->model(), before);
  document_->undoStack().redo();
  QCOMPARE(document_->model(), after);
  // Parameters and studies do not need the background.
  QVERIFY(document_->setValue(mass, "1.5 kg", "Mass"));
  QVERIFY(document_->setValue("/studies/0/frequency", "1.3 rad/s", "Frequency"));
  QCOMPARE(document_->undoStack().count(), 3);
  QCOMPARE(count, 1);
}

void TestDocument::laterEditsWaitBehindOneThatIsBuilt() {
  HeldWork held;
  document_->setBackground([&](document::BackgroundWork work) { held.work.push_back(std::move(work)); });
  QSignalSpy raised(document_.get(), &Document::messageRaised);
  QVERIFY(document_->setValue("/damping/mass_proportional", 0.5, "Damping"));
  QVERIFY(document_->setValue(mass, "1.5 kg", "Mass"));
  QVERIFY(document_->setValue("/damping/mass_proportional", -1, "Bad damping"));
  QCOMPARE(document_->undoStack().count(), 0);
  held.runAll();
  QVERIFY(!document_->isEditing());
  QCOMPARE(document_->undoStack().count(), 2);
  QCOMPARE(raised.count(), 1);
  QCOMPARE(document_->model()->massDamping, 0.5);
  QCOMPARE(document_->model()->parameters.front()->value(*document_->model()), 1.5);
}

void TestDocument::waitingEditsCanBeDropped() {
  HeldWork held;
  document_->setBackground([&](document::BackgroundWork work) { held.work.push_back(std::move(work)); });
  QVERIFY(document_->setValue("/damping/mass_proportional", 0.5, "Damping"));
  document_->cancelEdits();
  QVERIFY(!document_->isEditing());
  QVERIFY(document_->setValue("/damping/mass_proportional", 0.25, "Damping"));
  held.runAll();
  QCOMPARE(document_->undoStack().count(), 1);
  QCOMPARE(document_->valueAt("/damping/mass_proportional").get<double>(), 0.25);
  QVERIFY(document_->setValue("/damping/mass_proportional", 0.75, "Damping"));
  QVERIFY(document_->open(duffing));  // another scene: what waits was not about it
  held.runAll();
  QCOMPARE(document_->undoStack().count(), 0);
}

void TestDocument::badFilesLeaveTheDocument() {
  QTemporaryDir folder;
  const QString half = folder.filePath("half.json");
  QFile whole(duffing);
  QVERIFY(whole.open(QIODevice::ReadOnly));
  const QByteArray text = whole.readAll();
  QFile file(half);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(text.left(text.size() / 2));
  file.close();
  QVERIFY(document_->setValue(mass, "1.5 kg", "Mass"));
  const auto before = document_->scene().json();
  QSignalSpy raised(document_.get(), &Document::messageRaised);
  for (const QString& bad : {half, folder.filePath("missing.json")}) QVERIFY(!document_->open(bad));
  QCOMPARE(raised.count(), 2);
  QVERIFY(raised[0][1].toString().contains("half.json"));
  QVERIFY(document_->scene().json() == before);
  QVERIFY(document_->undoStack().canUndo());
  QCOMPARE(document_->file(), duffing);
}

void TestDocument::savingCleansAndCanBeReadBack() {
  QTemporaryDir folder;
  QVERIFY(document_->setValue(mass, "1.5 kg", "Mass"));
  const QString file = folder.filePath("saved.json");
  QVERIFY(document_->saveAs(file));
  QVERIFY(!document_->isModified());
  QCOMPARE(document_->savedValueAt(mass).get<double>(), 1.5);
  Document again;
  QVERIFY(again.open(file));
  QVERIFY(again.scene().json() == document_->scene().json());
  QVERIFY(!document_->saveAs(folder.filePath("no/such/folder/saved.json")));
}

void TestDocument::recentFilesAreNewestFirst() {
  QTemporaryDir folder;
  document::RecentFiles recent(false);
  for (int i = 0; i < 12; ++i) {
    QFile file(folder.filePath(QString("%1.json").arg(i)));
    QVERIFY(file.open(QIODevice::WriteOnly));
    recent.add(file.fileName());
  }
  recent.add(folder.filePath("5.json"));
  QCOMPARE(recent.files().size(), 10);
  QVERIFY(recent.files().first().endsWith("5.json"));
  QVERIFY(QFile::remove(folder.filePath("5.json")));
  QVERIFY(!recent.files().first().endsWith("5.json"));
}

QTEST_MAIN(TestDocument)
#include "test_document.moc"
