#include "base/math/shortest.h"

#include <catch2/catch.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace {

using wrlkit::write_shortest;

std::string shortest(double v) {
  char text[40];
  return {text, write_shortest(text, v)};
}

std::string by_the_library(double v) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, v).ptr};
}

}  // namespace

TEST_CASE("shortest: the text of std::to_chars at the bounds of the fast way", "[text]") {
  const double largest = std::numeric_limits<double>::max();
  for (double v : {0.0,           -0.0,           0.001,     0.0005, 0.000999999, 0.0010000001, 1.0, 10'000.0,
                   99'999.999999, 99'999.9999999, 100'000.0, 1e15,   1e300,       5e-324,       0.1, 0.1 + 0.2,
                   1.0 / 3,       0.125,          1e-6,      2.5e-7, 12.000001,   largest})
    for (double near : {v, std::nextafter(v, 0), std::nextafter(v, largest)}) {
      CHECK(shortest(near) == by_the_library(near));
      CHECK(shortest(-near) == by_the_library(-near));
    }
}

TEST_CASE("shortest: the text of std::to_chars for random numbers of any number of decimals", "[text]") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> size(-6, 18), sign(-1, 1);
  for (int i = 0; i < 300'000; ++i) {
    const double unit = std::pow(10.0, i % 9);
    const double v = std::copysign(std::round(std::pow(10.0, size(random))) / unit, sign(random));
    if (shortest(v) != by_the_library(v)) FAIL_CHECK(by_the_library(v) << " is written as " << shortest(v));
  }
}
