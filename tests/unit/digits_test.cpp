// The double that has the digits of a float, against the functions of the language that write and read these digits.
#include <bit>
#include <catch2/catch.hpp>
#include <charconv>
#include <cmath>
#include <random>

#include "base/math/digits.h"
#include "parsers/gltf/accessors.h"

using namespace wrlkit;

namespace {

double written_and_read(float f) {
  char text[32];
  double d = 0;
  std::from_chars(text, std::to_chars(text, text + sizeof text, f).ptr, d);
  return d;
}

void check(float f) {
  if (f == std::trunc(f)) return;  // whole numbers stay what they are
  INFO(f);
  const auto same = std::bit_cast<std::uint64_t>(written_and_read(f));
  REQUIRE(std::bit_cast<std::uint64_t>(decimal(f)) == same);
  REQUIRE(std::bit_cast<std::uint64_t>(gltf_reader::finite_decimal(f)) == same);
}

}  // namespace

TEST_CASE("Digits of floats: any bits") {
  std::mt19937 random(1);
  for (int i = 0; i < 200'000; ++i)
    if (const auto f = std::bit_cast<float>(static_cast<std::uint32_t>(random())); std::isfinite(f)) check(f);
}

TEST_CASE("Digits of floats: decimals, and their neighbours") {
  std::mt19937 random(2);
  for (int places = 0; places <= 9; ++places)
    for (int i = 0; i < 20'000; ++i) {
      const auto digits = static_cast<double>(random() >> (i % 32));
      const auto f = static_cast<float>((i % 2 ? 1 : -1) * digits / std::pow(10, places));
      check(f);
      check(std::nextafter(f, 1e30f));
      check(std::nextafter(f, -1e30f));
    }
}

TEST_CASE("Digits of floats: powers of two, where neighbours are not equally far") {
  for (int e = -126; e < 127; ++e) {
    const float f = std::ldexp(1.f, e);
    check(f);
    check(-std::nextafter(f, 0.f));
    check(std::nextafter(f, 1e30f));
  }
}
