#include "light/exposure.h"

#include <algorithm>
#include <cmath>

#include "base/math/digits.h"

namespace wrlkit {

bool Exposure::read(std::string_view text) {
  automatic = text == "auto";
  factor = 1;
  if (automatic) return true;
  return read_number(text, factor) && factor >= 1e-9 && factor <= 1e9;
}

std::string Exposure::print() const { return automatic ? "auto" : shortest_text(factor); }

namespace light {

double LightMeter::middle(std::size_t bin) {
  return std::exp2((static_cast<double>(bin) + 0.5) / steps - n_doublings / 2.0);
}

void LightMeter::add(double luminance) {
  if (!(luminance > 0)) return;
  const double at = (std::log2(luminance) + n_doublings / 2.0) * steps;
  ++counts_[static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(counts_.size() - 1)))];
}

void LightMeter::add(const LightMeter& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
}

double LightMeter::share_above(double luminance) const {
  std::uint64_t all = 0, above = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    all += counts_[i];
    if (middle(i) > luminance) above += counts_[i];
  }
  return all > 0 ? static_cast<double>(above) / static_cast<double>(all) : 0;
}

double LightMeter::factor(double target) const {
  constexpr double faint = 1e-3, most = 1e6, burnt = 4;
  double n = 0, sum = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    n += static_cast<double>(counts_[i]);
    sum += static_cast<double>(counts_[i]) * middle(i);
  }
  const double least = n > 0 ? faint * sum / n : 0;
  double n_seen = 0, logarithms = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (middle(i) < least) continue;
    n_seen += static_cast<double>(counts_[i]);
    logarithms += static_cast<double>(counts_[i]) * std::log2(middle(i));
  }
  if (!(n_seen > 0)) return 1;
  double brighter = 0;
  std::size_t half = counts_.size();
  while (2 * brighter < sum) {
    --half;
    brighter += static_cast<double>(counts_[half]) * middle(half);
  }
  const double wanted = std::min(target / std::exp2(logarithms / n_seen), burnt / middle(half));
  return to_digits(std::clamp(wanted, 1 / most, most), 3);
}

}  // namespace light
}  // namespace wrlkit
