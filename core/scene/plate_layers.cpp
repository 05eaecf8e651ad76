#include "core/scene/plate_layers.hpp"

#include <algorithm>
#include <numeric>

namespace pliant::scene {

namespace {

/// Places plates one after another, those with most neighbours first, and goes back where a rule is broken.
class LayerSearch {
 public:
  LayerSearch(const LayerRules& rules, int layerCount)
      : rules_(rules), layerCount_(layerCount), order_(rules.apart.size()), layers_(rules.apart.size(), -1) {
    std::iota(order_.begin(), order_.end(), 0);
    const auto neighbours = [&](int plate) {
      return std::count(rules.apart[plate].begin(), rules.apart[plate].end(), 1);
    };
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return neighbours(a) > neighbours(b); });
  }

  bool run() { return place(0); }
  const std::vector<int>& layers() const { return layers_; }

 private:
  bool place(std::size_t next) {
    if (next == order_.size()) return true;
    const int plate = order_[next];
    for (int layer = 0; layer < layerCount_ && stepsLeft_ > 0; ++layer) {
      --stepsLeft_;
      layers_[plate] = layer;
      if (isAllowed(plate) && place(next + 1)) return true;
    }
    layers_[plate] = -1;
    return false;
  }

  bool isAllowed(int plate) const {
    for (std::size_t other = 0; other < layers_.size(); ++other)
      if (rules_.apart[plate][other] && layers_[other] == layers_[plate]) return false;
    return std::all_of(rules_.pins.begin(), rules_.pins.end(), [&](const LayerRules::Pin& pin) {
      int lowest = layerCount_, highest = -1;
      for (const int member : pin.plates)
        if (layers_[member] >= 0)
          lowest = std::min(lowest, layers_[member]), highest = std::max(highest, layers_[member]);
      return std::none_of(pin.kept.begin(), pin.kept.end(),
                          [&](int kept) { return layers_[kept] > lowest && layers_[kept] < highest; });
    });
  }

  const LayerRules& rules_;
  const int layerCount_;
  long stepsLeft_ = 200'000;
  std::vector<int> order_, layers_;
};

}  // namespace

std::optional<std::vector<int>> assignLayers(const LayerRules& rules) {
  const int plates = static_cast<int>(rules.apart.size());
  for (int layerCount = 1; layerCount <= plates; ++layerCount)
    if (LayerSearch search(rules, layerCount); search.run()) return search.layers();
  return std::nullopt;
}

}  // namespace pliant::scene
