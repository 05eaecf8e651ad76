#include "ui/panels/response_panel.hpp"

#include <QComboBox>
#include <QEvent>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>

#include "core/base/error.hpp"
#include "ui/jobs/node_correspondence.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/response_overlays.hpp"
#include "ui/plots/plot_export.hpp"
#include "ui/plots/shape_image.hpp"

namespace pliant::panels {

using document::StudyStatus;
using jobs::AmplitudeMeasure;
using plots::ResponseCurve;
using plots::ResponsePlace;

namespace {

constexpr QSize insetSize{120, 84};
const QString amplitudeTopic = QStringLiteral("amplitudes");

bool isCurve(const document::StudyState& study) {
  return study.type.ends_with("_response") || study.type == "backbone";
}

double probeAmplitude(const harmonic::ResponsePoint& point, std::size_t probe, AmplitudeMeasure measure) {
  if (probe >= point.amplitudes.size()) return 0;
  const harmonic::Amplitude& amplitude = point.amplitudes[probe];
  return measure == AmplitudeMeasure::pathLength ? amplitude.pathLength : amplitude.maximumDisplacement;
}

/// All nodes where one of them is farthest from its mean position.
harmonic::Vector positionsFarthestOut(const harmonic::HarmonicBalanceProblem& problem, const harmonic::Vector& z,
                                      int node) {
  const harmonic::Matrix samples = problem.trajectories(z);
  const int dimension = problem.model().dimension;
  const harmonic::Matrix path = samples.middleCols(Eigen::Index{node} * dimension, dimension);
  const Eigen::RowVectorXd mean = path.colwise().mean();
  Eigen::Index farthest = 0;
  for (Eigen::Index i = 1; i < path.rows(); ++i)
    if ((path.row(i) - mean).norm() > (path.row(farthest) - mean).norm()) farthest = i;
  return samples.row(farthest);
}

}  // namespace

ResponsePanel::ResponsePanel(document::Document& document, jobs::MotionSession& session, jobs::JobRunner& quick,
                             QWidget* parent)
    : QWidget(parent), document_(document), session_(session), quick_(quick), predictor_(document, session) {
  studies_ = new QComboBox;
  studies_->setToolTip(tr("Which study's curve is shown"));
  nodes_ = new QComboBox;
  nodes_->setToolTip(tr("Whose amplitude is shown; click a node in the viewport to choose another"));
  nodes_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  measures_ = new QComboBox;
  measures_->addItem(tr("path length"));
  measures_->addItem(tr("largest displacement"));
  measures_->setToolTip(
      tr("Path length: the way the node travels in one period.\n"
         "Largest displacement: how far it gets from its mean position."));
  unit_ = new QToolButton;
  unit_->setCheckable(true);
  unit_->setText(QStringLiteral("rad/s"));
  unit_->setMinimumWidth(64);
  unit_->setToolTip(tr("Frequency in rad/s or Hz"));
  scale_ = new QToolButton;
  scale_->setCheckable(true);
  scale_->setText(tr("log"));
  scale_->setToolTip(tr("Amplitudes on a logarithmic axis"));
  QToolButton* menu = makeMenuButton();
  for (QWidget* widget :
       {static_cast<QWidget*>(studies_), static_cast<QWidget*>(nodes_), static_cast<QWidget*>(measures_),
        static_cast<QWidget*>(unit_), static_cast<QWidget*>(scale_), static_cast<QWidget*>(menu)})
    widget->setFixedHeight(28);
  plot_ = new plots::ResponsePlot;

  auto* head = new QHBoxLayout;
  head->setContentsMargins(16, 4, 16, 4);
  head->setSpacing(8);
  head->addWidget(studies_);
  head->addWidget(new QLabel(tr("Amplitude of")));
  head->addWidget(nodes_);
  head->addWidget(new QLabel(tr("by")));
  head->addWidget(measures_);
  head->addStretch();
  head->addWidget(scale_);
  head->addWidget(unit_);
  head->addWidget(menu);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(plot_, 1);

  connect(studies_, &QComboBox::activated, this, &ResponsePanel::chooseStudy);
  connect(nodes_, &QComboBox::activated, this, [this] { session_.selectNode(nodes_->currentData().toInt()); });
  connect(measures_, &QComboBox::activated, this, [this](int index) {
    session_.setMeasure(index == 0 ? AmplitudeMeasure::pathLength : AmplitudeMeasure::maximumDisplacement);
  });
  connect(unit_, &QToolButton::toggled, this, [this](bool hertz) {
    setHertz(hertz);
    Q_EMIT hertzChanged(hertz);
  });
  connect(scale_, &QToolButton::toggled, plot_, &plots::ResponsePlot::setLogarithmic);
  connect(plot_, &plots::ResponsePlot::pointChosen, this, [this](int index) { session_.showPoint(study_, index); });
  connect(plot_, &plots::ResponsePlot::frequencyRequested, this,
          [this](double omega, int nearest) { session_.solveAt(omega, study_, nearest); });
  connect(plot_, &plots::ResponsePlot::updateRequested, &session_, &jobs::MotionSession::update);
  connect(plot_, &plots::ResponsePlot::emptyActionTriggered, this, [this] {
    if (!study_.empty()) session_.run({study_});
  });
  connect(plot_, &plots::ResponsePlot::readoutChanged, this, &ResponsePanel::readoutChanged);

  connect(&document_, &document::Document::sceneReplaced, this, &ResponsePanel::rebuild);
  connect(&document_, &document::Document::sceneEdited, this, [this] {
    fillStudies();
    fillNodes();
    refreshCurve();
    refreshMarkers();
  });
  connect(&document_, &document::Document::studyChanged, this, [this](const std::string& name) {
    refreshOverlays();
    if (name != study_) return;
    refreshEmptyState();
    refreshCurve();
  });
  connect(&session_, &jobs::MotionSession::nodeChanged, this, [this] {
    fillNodes();
    refreshCurve();
    refreshMarkers();
  });
  connect(&session_, &jobs::MotionSession::measureChanged, this, [this] {
    measures_->setCurrentIndex(session_.measure() == AmplitudeMeasure::pathLength ? 0 : 1);
    refreshCurve();
    refreshMarkers();
  });
  connect(&session_, &jobs::MotionSession::shownChanged, this, &ResponsePanel::refreshMarkers);
  connect(&session_, &jobs::MotionSession::predictionChanged, this, &ResponsePanel::refreshMarkers);
  connect(&predictor_, &jobs::CurvePredictor::changed, this, &ResponsePanel::refreshPredictedCurve);
  rebuild();
}

QToolButton* ResponsePanel::makeMenuButton() {
  auto* button = new QToolButton;
  button->setText(tr("Compare"));
  button->setPopupMode(QToolButton::InstantPopup);
  button->setToolTip(tr("Other studies and measurements in the same plot; export"));
  auto* menu = new QMenu(button);
  compare_ = menu->addAction(tr("Show other studies"));
  compare_->setCheckable(true);
  compare_->setChecked(true);
  connect(compare_, &QAction::toggled, this, &ResponsePanel::refreshOverlays);
  shapes_ = menu->addAction(tr("Show shapes at the peaks"));
  shapes_->setCheckable(true);
  connect(shapes_, &QAction::toggled, this, &ResponsePanel::refreshInsets);
  const auto choose = [this](auto&& act) {
    try {
      act();
    } catch (const base::InputError& error) {
      QMessageBox::warning(this, tr("Frequency response"), QString::fromUtf8(error.what()));
    }
  };
  menu->addAction(tr("Import measurements…"), this, [this, choose] {
    const QString file = QFileDialog::getOpenFileName(
        this, tr("Measurements: frequency [Hz], amplitude [mm]"), {}, tr("Comma-separated values (*.csv)"));
    if (!file.isEmpty()) choose([&] { addMeasurements(file); });
  });
  menu->addAction(tr("Remove measurements"), this, [this] {
    measurements_.clear();
    refreshOverlays();
  });
  menu->addSeparator();
  menu->addAction(tr("Export plot…"), this, [this, choose] {
    const QString file =
        QFileDialog::getSaveFileName(this, tr("Export the plot"), {}, tr("PDF (*.pdf);;SVG (*.svg);;PNG (*.png)"));
    if (!file.isEmpty()) choose([&] { plots::exportPlot(*plot_->plot(), file, {}); });
  });
  button->setMenu(menu);
  return button;
}

void ResponsePanel::addMeasurements(const QString& file) {
  measurements_.push_back(readMeasurements(file));
  refreshOverlays();
}

void ResponsePanel::refreshOverlays() {
  std::vector<plots::ResponseOverlay> overlays;
  if (compare_->isChecked() && !document_.isEmpty())
    overlays = studyOverlays(document_, study_, session_.node(), session_.measure());
  overlays.insert(overlays.end(), measurements_.begin(), measurements_.end());
  plot_->setOverlays(std::move(overlays));
}

void ResponsePanel::setHertz(bool hertz) {
  unit_->setChecked(hertz);
  unit_->setText(hertz ? QStringLiteral("Hz") : QStringLiteral("rad/s"));
  plot_->setHertz(hertz);
}

void ResponsePanel::rebuild() {
  drawn_.reset();
  predictor_.setCurve(nullptr, std::nullopt);
  measurements_.clear();
  plot_->clear();
  studies_->clear();
  fillStudies();
  fillNodes();
  chooseStudy();
}

void ResponsePanel::fillStudies() {
  const QString before = studies_->currentText();
  {
    const QSignalBlocker block(studies_);
    studies_->clear();
    for (const auto& study : document_.studies())
      if (isCurve(study)) studies_->addItem(QString::fromStdString(study.name));
    studies_->setCurrentIndex(std::max(0, studies_->findText(before)));
    studies_->setVisible(studies_->count() > 1);
  }
  if (studies_->currentText() != before) chooseStudy();
}

void ResponsePanel::fillNodes() {
  const QSignalBlocker block(nodes_);
  nodes_->clear();
  if (document_.isEmpty()) return;
  const mechanics::Model& model = *document_.model();
  for (const auto& probe : model.probes) nodes_->addItem(QString::fromStdString(probe.name), probe.node);
  if (probeOf(model, session_.node()) < 0) nodes_->addItem(nodeName(model, session_.node()), session_.node());
  nodes_->setCurrentIndex(nodes_->findData(session_.node()));
}

void ResponsePanel::chooseStudy() {
  study_ = studies_->currentText().toStdString();
  predictor_.setCurve(nullptr, std::nullopt);
  drawn_.reset();
  plot_->clear();
  refreshEmptyState();
  refreshCurve();
  refreshMarkers();
}

void ResponsePanel::refreshEmptyState() {
  if (document_.isEmpty())
    plot_->setEmptyState(tr("Open a scene to see how far it swings at which frequency."), {});
  else if (study_.empty())
    plot_->setEmptyState(
        tr("A study of the type frequency_response or backbone fills this plot. This scene has none."), {});
  else if (const auto* study = document_.study(study_); study && study->status == StudyStatus::waiting)
    plot_->setEmptyState(tr("The study “%1” begins when what runs before it is done.").arg(study_.c_str()), {});
  else
    plot_->setEmptyState(tr("The study “%1” traces how far a node swings at which frequency.").arg(study_.c_str()),
                         tr("Run %1").arg(study_.c_str()));
}

void ResponsePanel::refreshCurve() {
  const document::StudyState* study = document_.study(study_);
  if (!study) return;  // none is left; `chooseStudy` has cleared the plot
  for (const auto& entry : document_.valueAt("/studies"))
    if (entry.value("name", "") == study_) plot_->setFrequencyRange(entry.value("from", 0.0), entry.value("to", 0.0));
  refreshOverlays();
  const QString measure = session_.measure() == AmplitudeMeasure::pathLength ? tr("Path length") : tr("Displacement");
  plot_->setAmplitudeLabel(measure);
  const auto result = std::dynamic_pointer_cast<const scene::HarmonicResult>(study->result);
  drawn_ = result;
  followCurve();
  if (!result) {
    quick_.cancelTopic(amplitudeTopic);
    showCurves(nullptr, {});
    return;
  }
  const int node = jobs::correspondingNode(*document_.model(), session_.node(), result->problem->model());
  if (node < 0) {
    showCurves(nullptr, {});
    return;
  }
  const int probe = probeOf(result->problem->model(), node);
  if (probe >= 0) {
    std::vector<double> amplitudes;
    for (const auto& point : result->points)
      amplitudes.push_back(probeAmplitude(point, static_cast<std::size_t>(probe), session_.measure()));
    showCurves(result.get(), amplitudes);
    return;
  }
  jobs::Job job;
  job.topic = amplitudeTopic;
  job.work = [this, result, node, measure = session_.measure()](
                 base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
    std::vector<double> amplitudes;
    for (const auto& point : result->points) {
      if (context.cancelRequested()) return {};
      amplitudes.push_back(jobs::amplitudeOf(*result->problemOf(point), point.z, node, measure));
    }
    return [this, result, amplitudes] {
      if (drawn_ == result) showCurves(result.get(), amplitudes);
    };
  };
  quick_.submit(std::move(job));
}

void ResponsePanel::showCurves(const scene::HarmonicResult* result, const std::vector<double>& amplitudes) {
  const document::StudyState& study = *document_.study(study_);
  std::vector<ResponseCurve> curves;
  peaks_.clear();
  if (result) {
    const mechanics::Model& model = result->problem->model();
    const int node = jobs::correspondingNode(*document_.model(), session_.node(), model);
    ResponseCurve selected;
    selected.name = nodeName(model, node);
    selected.amplitude = amplitudes;
    for (const auto& point : result->points) {
      selected.omega.push_back(point.omega);
      // A peak belongs to one probe; folds to all.
      const bool others =
          point.kind == harmonic::PointKind::peak && point.probe >= 0 && point.probe != probeOf(model, node);
      selected.kinds.push_back(others ? harmonic::PointKind::regular : point.kind);
      selected.unstable.push_back(point.stability.state == harmonic::StabilityState::unstable);
      selected.branches.push_back(point.branch);
    }
    for (std::size_t i = 0; i < result->points.size(); ++i) {
      if (selected.kinds[i] != harmonic::PointKind::peak) continue;
      const harmonic::ResponsePoint& peak = result->points[i];
      const auto problem = result->problemOf(peak);
      peaks_.push_back(
          {{peak.omega, amplitudes[i]}, problem->sharedModel(), positionsFarthestOut(*problem, peak.z, node)});
    }
    curves.push_back(selected);
    for (std::size_t probe = 0; probe < model.probes.size(); ++probe) {
      if (model.probes[probe].node == node) continue;
      ResponseCurve other;
      other.name = QString::fromStdString(model.probes[probe].name);
      other.omega = selected.omega;
      other.branches = selected.branches;
      for (const auto& point : result->points)
        other.amplitude.push_back(probeAmplitude(point, probe, session_.measure()));
      curves.push_back(std::move(other));
    }
  }
  plot_->setCurves(std::move(curves), 0, study.status, study.stale, study.message);
  refreshInsets();
}

void ResponsePanel::refreshInsets() {
  std::vector<plots::ResponseInset> insets;
  if (shapes_->isChecked())
    for (const ShapeAt& peak : peaks_)
      insets.push_back(
          {peak.place, plots::shapeImage(*peak.model, peak.positions, insetSize, devicePixelRatioF(), palette())});
  std::stable_sort(
      insets.begin(), insets.end(), [](const auto& a, const auto& b) { return a.place.amplitude > b.place.amplitude; });
  plot_->setInsets(std::move(insets));
}

void ResponsePanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) refreshInsets();
}

void ResponsePanel::refreshMarkers() {
  refreshPredictedCurve();
  const auto& shown = session_.shown();
  if (!shown) {
    plot_->setShownMotion(std::nullopt);
    plot_->setPrediction(std::nullopt);
    return;
  }
  plot_->setShownMotion(ResponsePlace{shown->motion.omega, session_.shownAmplitude()});
  const auto predicted = session_.predictedAmplitude();
  if (predicted)
    plot_->setPrediction(ResponsePlace{shown->motion.omega, *predicted});
  else
    plot_->setPrediction(std::nullopt);
}

}  // namespace pliant::panels
