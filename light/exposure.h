// By what factor light is shown: an option, and how it is found from the light itself.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace wrlkit {

struct Exposure {
  static constexpr std::string_view type = "number above 0, or auto";
  bool automatic = false;
  double factor = 1;  // on linear light

  bool read(std::string_view text);
  std::string print() const;
};

namespace light {

/// Counts of how bright places are, in steps of a sixty-fourth of a doubling: sums, so that their order does not
/// matter.
class LightMeter {
 public:
  /// A linear luminance, or the mean of linear channels; black does not count.
  void add(double luminance);
  void add(const LightMeter& other);
  /// The factor by which the logarithmic mean becomes `target` (Reinhard et al. 2002). Places of less than a thousandth
  /// of the mean do not count: no light reaches them, and nobody looks there. No more than makes half of all light four
  /// times as bright as white, where a little of the world is lit and the rest is not. 1 when there are no others.
  /// Between 1e-6 and 1e6, of three digits, so that what is printed is what was taken.
  double factor(double target) const;
  /// The share of places that are brighter; 0 when there are none.
  double share_above(double luminance) const;

 private:
  static constexpr int steps = 64, n_doublings = 64;  // of a doubling; from 2^-32 on
  static double middle(std::size_t bin);

  std::array<std::uint64_t, std::size_t{steps} * n_doublings> counts_{};
};

}  // namespace light
}  // namespace wrlkit
