#pragma once

#include <QWidget>
#include <functional>
#include <vector>

class QCPCurve;
class QCPItemStraightLine;
class QCPItemText;
class QCustomPlot;
class QLabel;
class QStackedLayout;

namespace pliant::plots {

/// One line of a plot; lines of one group have one colour.
struct PlotLine {
  QString name;  ///< in the legend; empty: it has no place there
  std::vector<double> x, y;
  int group = 0;
  bool dashed = false;
  bool dots = false;   ///< its points are marked
  bool joined = true;  ///< by a line
  /// What each point is of, by numbers of whoever made the chart; empty: of nothing that can be chosen.
  std::vector<int> items{};
};

/// What a line plot shows; units stand in the labels.
struct LineChart {
  QString xLabel, yLabel;
  bool logarithmicY = false;  ///< values that are not above 0 are left out
  std::vector<PlotLine> lines;
  bool legendBelow = false;  ///< in the lower left corner, for lines that begin high
  bool fromZero = false;     ///< the y-axis begins at 0, and values have room on both sides of the x-axis
};

/// Some lines that may grow, in colours that are told apart by the colour-blind; a line marks an instant. Wheel and
/// drag zoom and pan, a double click shows everything, and whatever grows is shown as long as nobody has zoomed.
class LinePlot final : public QWidget {
  Q_OBJECT

 public:
  explicit LinePlot(QWidget* parent = nullptr);

  void setChart(LineChart chart);
  /// A sentence instead of lines.
  void setNote(const QString& sentence);
  /// Marks a place of the x-axis; NaN: none.
  void setInstant(double x);
  /// What is said of an item under the pointer.
  void setItemText(std::function<QString(int item)> text) { itemText_ = std::move(text); }
  /// Marks the points of an item, or its line if a whole line is of it; -1: none.
  void setChosenItem(int item);
  int chosenItem() const { return chosenItem_; }
  void fit();

  QCustomPlot* plot() const { return plot_; }
  /// What stands beside the pointer; empty: nothing.
  QString hoverText() const;
  const LineChart& chart() const { return chart_; }
  /// What is shown as text, two columns a line.
  QString toCsv() const;

  QSize sizeHint() const override { return {480, 240}; }
  QSize minimumSizeHint() const override { return {240, 140}; }

 Q_SIGNALS:
  /// A click at this place of the x-axis.
  void placeChosen(double x);
  /// A click at a point of an item, instead.
  void itemChosen(int item);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void redraw();
  void applyStyle();
  Qt::Alignment legendCorner() const;
  void makeItemMarks();
  void markChosenItem();
  void hover(const QPointF& pixel);
  /// The item whose point is drawn nearest to a pixel and not far from it; -1 if there is none.
  int itemAt(const QPointF& pixel) const;

  QStackedLayout* pages_;
  QCustomPlot* plot_;
  QLabel* note_;
  QCPItemStraightLine* instant_ = nullptr;
  LineChart chart_;
  double shownInstant_ = 0;
  bool instantSet_ = false;
  bool zoomed_ = false;
  QPoint press_;
  std::function<QString(int)> itemText_;
  int chosenItem_ = -1;
  QCPCurve* chosenPoints_ = nullptr;
  QCPCurve* chosenLine_ = nullptr;
  QCPItemText* hoverLabel_ = nullptr;
};

}  // namespace pliant::plots
