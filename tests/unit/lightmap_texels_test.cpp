// What happens to the texels of a lightmap, on pages made by hand.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "passes/lightmap/denoise.h"
#include "passes/lightmap/fill.h"
#include "passes/lightmap/refine.h"
#include "passes/lightmap/seams.h"
#include "passes/lightmap/specks.h"
#include "passes/lightmap/texels.h"

using namespace wrlkit::bake;

namespace {

/// All texels of all tiles.
std::vector<std::pair<TexelSamples, std::vector<SurfaceSample>>> all_texels(
    const std::vector<PlacedTriangle>& triangles, int width, int height, int side, int most = 1000) {
  TexelGrid grid(triangles, width, height);
  std::vector<std::pair<TexelSamples, std::vector<SurfaceSample>>> out;
  TileTexels tile;
  for (std::size_t i = 0; i < grid.n_tiles(); ++i) {
    grid.texels_of(i, side, most, tile);
    for (auto& t : tile.texels)
      out.push_back({t, {tile.samples.begin() + t.first, tile.samples.begin() + t.first + t.count}});
  }
  return out;
}

/// A square of two triangles.
std::vector<PlacedTriangle> square(float x0, float y0, float x1, float y1, std::uint32_t chart = 0) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}}, chart}, {{{x0, y0}, {x1, y1}, {x0, y1}}, chart}};
}

/// A flat page of light 1 with noise of a known size on it.
struct Noisy : Page, Estimate {
  using Estimate::light;
  explicit Noisy(int side) : Page(side, side), Estimate(static_cast<const Page&>(*this)) {}
};

Noisy noisy_page(int side, float deviation, unsigned seed = 7) {
  Noisy page(side);
  std::mt19937 random(seed);
  std::normal_distribution<float> noise;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      auto i = page.at(x, y);
      page.places[i] = {0, {x * 0.1f, y * 0.1f, 0}, {0, 0, 1}};
      float v = 1 + deviation * noise(random);
      page.light()[i] = {v, v, v};
      page.variance[i] = deviation * deviation;
    }
  return page;
}

double deviation_from(const Noisy& page, int x0, int x1, float mean) {
  double sum = 0;
  int n = 0;
  for (int y = 4; y < page.height - 4; ++y)
    for (int x = x0; x < x1; ++x, ++n) sum += std::pow(page.light()[page.at(x, y)].g - mean, 2);
  return std::sqrt(sum / n);
}

float shown(const std::vector<Rgb>& texels, int width, float x, float y) {
  x -= 0.5f;
  y -= 0.5f;
  int u = static_cast<int>(std::floor(x)), v = static_cast<int>(std::floor(y));
  float fx = x - u, fy = y - v;
  auto at = [&](int i, int j) { return texels[std::size_t(j) * width + i].r; };
  return (1 - fy) * ((1 - fx) * at(u, v) + fx * at(u + 1, v)) + fy * ((1 - fx) * at(u, v + 1) + fx * at(u + 1, v + 1));
}

}  // namespace

TEST_CASE("texels: a square on whole texels covers them with all samples, and its rim by the nearest point") {
  auto texels = all_texels(square(2, 3, 6, 5), 16, 16, 4);
  std::size_t whole = 0, rim = 0;
  for (auto& [t, samples] : texels) {
    bool inside = t.x >= 2 && t.x < 6 && t.y >= 3 && t.y < 5;
    if (inside) {
      ++whole;
      CHECK(samples.size() == 16);
    } else {
      ++rim;
      CHECK(samples.size() == 1);
      CHECK((t.x >= 1 && t.x < 7 && t.y >= 2 && t.y < 6));
    }
  }
  CHECK(whole == 8);
  CHECK(rim == 16);  // what a bilinear filter mixes at the border: one texel around, corners too
}

TEST_CASE("texels: the samples of a texel are the share of it that is covered") {
  auto texels = all_texels(square(2.25f, 3, 3, 4), 8, 8, 4);
  for (auto& [t, samples] : texels)
    if (t.x == 2 && t.y == 3) CHECK(samples.size() == 12);
}

TEST_CASE("texels: samples lie where their weights say, whatever the tile") {
  auto triangles = square(40.3f, 50.7f, 90.1f, 70.2f);
  for (auto& [t, samples] : all_texels(triangles, 128, 128, 3)) {
    for (auto& s : samples) {
      float x = 0, y = 0;
      for (int k = 0; k < 3; ++k) {
        x += s.weight[k] * triangles[s.triangle].corner[k].x;
        y += s.weight[k] * triangles[s.triangle].corner[k].y;
      }
      float slack = samples.size() == 1 ? 1.0f : 1e-3f;
      CHECK(x >= t.x - slack);
      CHECK(x <= t.x + 1 + slack);
      CHECK(y >= t.y - slack);
      CHECK(y <= t.y + 1 + slack);
    }
  }
}

TEST_CASE("texels: a triangle smaller than a texel has one") {
  auto texels = all_texels({{{{5.6f, 5.6f}, {5.7f, 5.6f}, {5.6f, 5.7f}}, 3}}, 16, 16, 4);
  REQUIRE(!texels.empty());
  CHECK(std::ranges::any_of(texels, [](auto& t) { return t.first.x == 5 && t.first.y == 5; }));
}

TEST_CASE("texels: a triangle that runs clockwise, as those of a mirrored Shape do, has the samples of the other") {
  const PlacedTriangle one{{{1, 1}, {7, 2}, {3, 6}}, 0}, turned{{{1, 1}, {3, 6}, {7, 2}}, 0};
  const auto a = all_texels({one}, 8, 8, 4), b = all_texels({turned}, 8, 8, 4);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].second.size() == b[i].second.size());
    for (std::size_t k = 0; k < a[i].second.size(); ++k)
      CHECK(a[i].second[k].weight[1] == Approx(b[i].second[k].weight[2]).margin(1e-5));
  }
}

TEST_CASE("texels: a triangle without area takes no texel of what lies beside it") {
  const auto texels = all_texels({{{{0, 0}, {4, 4}, {8, 8}}, 0}, {{{5, 0}, {8, 0}, {8, 3}}, 1}}, 8, 8, 4);
  for (auto& [t, samples] : texels)
    if (t.x == 7 && t.y == 0) CHECK(samples[0].triangle == 1);
}

TEST_CASE("texels: no more samples than are asked for, spread over the texel") {
  for (auto& [t, samples] : all_texels(square(0, 0, 8, 8), 8, 8, 4, 4)) {
    CHECK(samples.size() == 4);
    float low = 8, high = 0;
    for (auto& s : samples) {
      low = std::min(low, s.weight[0]);
      high = std::max(high, s.weight[0]);
    }
    CHECK(high > low);
  }
}

TEST_CASE("denoise: noise on a plane falls to a quarter, and the mean stays") {
  auto page = noisy_page(64, 0.1f);
  denoise(page, page);
  CHECK(deviation_from(page, 4, 60, 1) < 0.025);
  double mean = 0;
  for (auto& c : page.light()) mean += c.g;
  CHECK(mean / page.size() == Approx(1).epsilon(0.005));
}

TEST_CASE("denoise: a step that is larger than the noise stays sharp") {
  auto page = noisy_page(64, 0.02f);
  for (int y = 0; y < 64; ++y)
    for (int x = 32; x < 64; ++x) page.light()[page.at(x, y)] = page.light()[page.at(x, y)] + Rgb{2, 2, 2};
  denoise(page, page);
  CHECK(deviation_from(page, 24, 32, 1) < 0.01);
  CHECK(deviation_from(page, 32, 40, 3) < 0.01);
}

TEST_CASE("denoise: detail of one texel that is more than the noise stays") {
  constexpr float noise = 0.02f;
  auto page = noisy_page(64, noise);
  double off = 0;
  auto detail = [](std::size_t i) { return i % 64 % 2 ? 0.1f : -0.1f; };
  for (std::size_t i = 0; i < page.size(); ++i) page.light()[i] += detail(i) * Rgb{1, 1, 1};
  denoise(page, page);
  for (int y = 4; y < 60; ++y)
    for (int x = 4; x < 60; ++x)
      off += std::pow(page.light()[page.at(x, y)].g - 1 - detail(page.at(x, y)), 2) / (56 * 56);
  CHECK(std::sqrt(off) < 1.2 * noise);
}

TEST_CASE("denoise: light is not mixed between charts, around a crease or without noise") {
  SECTION("charts") {
    auto page = noisy_page(32, 0.5f);
    for (std::size_t i = 0; i < page.size(); ++i)
      if (i % 32 >= 16) {
        page.places[i].chart = 1;
        page.light()[i] = {0, 0, 0};
      }
    denoise(page, page);
    CHECK(deviation_from(page, 16, 32, 0) == 0);
  }
  SECTION("a crease") {
    auto page = noisy_page(32, 0.5f);
    for (std::size_t i = 0; i < page.size(); ++i)
      if (i % 32 >= 16) {
        page.places[i].normal = {1, 0, 0};
        page.light()[i] = {0, 0, 0};
      }
    denoise(page, page);
    CHECK(deviation_from(page, 16, 32, 0) == 0);
  }
  SECTION("no noise") {
    auto page = noisy_page(32, 0.1f);
    auto before = page.light();
    std::ranges::fill(page.variance, 0.0f);
    denoise(page, page);
    for (std::size_t i = 0; i < page.size(); ++i) CHECK(page.light()[i].r == Approx(before[i].r).epsilon(1e-3));
  }
}

TEST_CASE(
    "denoise: two estimates, of which the one has an edge and the other noise, keep the edge and lose the noise") {
  const auto noisy = noisy_page(64, 0.1f);
  Estimate edge(static_cast<const Page&>(noisy));
  for (std::size_t i = 0; i < noisy.size(); ++i) edge.light()[i] = i % 64 < 32 ? Rgb{} : Rgb{1, 1, 1};
  const auto shown = shown_light(noisy, edge, noisy, true);
  double left = 0, right = 0, off = 0;
  for (int y = 4; y < 60; ++y) {
    left += shown[noisy.at(31, y)].g / 56;
    right += shown[noisy.at(32, y)].g / 56;
    for (int x = 4; x < 60; ++x) off += std::pow(shown[noisy.at(x, y)].g - (x < 32 ? 1 : 2), 2);
  }
  CHECK(right - left == Approx(1).margin(0.01));
  CHECK(std::sqrt(off / (56 * 56)) < 0.025);
  const auto plain = shown_light(noisy, edge, noisy, false);
  CHECK(plain[40].g == noisy.light()[40].g + 1);
}

TEST_CASE("denoise: light of lamps that says it has no noise is filtered where the rest has much") {
  // One texel in twelve is in a shadow that it says to be certain of.
  const auto noisy = noisy_page(64, 0.2f);
  Estimate lamps(static_cast<const Page&>(noisy));
  for (std::size_t i = 0; i < noisy.size(); ++i)
    lamps.light()[i] = i % 64 % 4 == 1 && i / 64 % 3 == 1 ? Rgb{0.85f, 0.85f, 0.85f} : Rgb{1, 1, 1};
  const auto shown = shown_light(noisy, lamps, noisy, true);
  double off = 0;
  for (int y = 4; y < 60; ++y)
    for (int x = 4; x < 60; ++x) off += std::pow(shown[noisy.at(x, y)].g - (2 - 0.15 / 12), 2) / (56 * 56);
  CHECK(std::sqrt(off) < 0.035);
}

TEST_CASE("refine: the error of what is shown is known without knowing the light, blurred detail and noise alike") {
  // Stripes of that contrast below noise of that size, in each half of the rays.
  for (auto [stripes, noise] : {std::pair(0.0f, 0.2f), {0.1f, 0.2f}, {0.1f, 0.05f}, {0.3f, 0.1f}})
    for (bool denoised : {true, false}) {
      CAPTURE(stripes, noise, denoised);
      constexpr int side = 128;
      const auto one = noisy_page(side, noise, 1), other = noisy_page(side, noise, 2);
      PageLight light(one, false);
      Halves halves(one.size());
      std::vector<float> truth(one.size());
      double all = 0;
      for (std::size_t i = 0; i < one.size(); ++i) {
        truth[i] = 1 + (i % side / 3 % 2 ? stripes : 0);
        const Rgb detail = (truth[i] - 1) * Rgb{1, 1, 1};
        light.gathered.light()[i] = 0.5f * (one.light()[i] + other.light()[i]) + detail;
        light.gathered.variance[i] = 0.5f * noise * noise;
        halves.gathered[i] = 0.5f * (one.light()[i] - other.light()[i]);
        all += truth[i] / double(one.size());
      }
      const auto shown = shown_light(one, light.direct, light.gathered, denoised);
      double off = 0;
      for (std::size_t i = 0; i < one.size(); ++i) off += std::pow(shown[i].g - truth[i], 2) / double(one.size());
      const double error = std::sqrt(off) / all;
      auto wanting = [&](double wanted) {
        return std::ranges::count(unsettled(one, light, halves, wanted, denoised), 1);
      };
      CHECK(wanting(0.75 * error) > 0);
      CHECK(wanting(1.75 * error) == 0);
    }
}

TEST_CASE("fill: unknown texels take the light around them, known ones stay") {
  std::vector<Rgb> texels(13 * 9);
  std::vector<char> known(texels.size());
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 13; ++x)
      if (x < 3) {
        texels[y * 13 + x] = {0.5f, 1, 2};
        known[y * 13 + x] = 1;
      }
  fill(texels, known, 13, 9);
  for (auto& t : texels) {
    CHECK(t.r == Approx(0.5f));
    CHECK(t.b == Approx(2));
  }
  std::vector<Rgb> none(4, Rgb{1, 1, 1});
  fill(none, {0, 0, 0, 0}, 2, 2);
  CHECK(none[0].r == 0);
}

TEST_CASE("fill: charts go on with their own light before that of others comes in") {
  constexpr std::uint32_t none = 99;
  // When two rows touch, the lower one is chart 0, of which the left half is known, and the upper one chart 1, of
  // which all is.
  std::vector<std::uint32_t> chart(2 * 12);
  std::vector<std::vector<Rgb>> layers(2, std::vector<Rgb>(chart.size()));
  std::vector<char> known(chart.size());
  for (int x = 0; x < 12; ++x) {
    chart[12 + x] = 1;
    known[12 + x] = 1;
    layers[0][12 + x] = {9, 9, 9};
    if (x < 6) {
      known[x] = 1;
      layers[0][x] = {0.25f, 0.5f, 1};
      layers[1][x] = {-1, 0, 0};
    }
  }
  chart[11] = none;
  known[11] = 0;
  fill_charts(layers, known, chart, none, 12, 2);
  for (int x = 0; x < 11; ++x) {
    CHECK(layers[0][x].g == Approx(0.5f));
    CHECK(layers[1][x].r == Approx(-1));
    CHECK(known[x] == 1);
  }
  CHECK(known[11] == 0);
}

TEST_CASE("specks: one that is darker than all around, and no shadow's edge") {
  auto page = noisy_page(16, 0);
  CHECK(count_specks(page, page.light()) == 0);
  for (int y = 0; y < 16; ++y) page.light()[page.at(4, y)] = {};
  CHECK(count_specks(page, page.light()) == 0);
  page.light()[page.at(10, 8)] = {0.3f, 0.3f, 0.3f};
  CHECK(count_specks(page, page.light()) == 1);
  page.light()[page.at(10, 8)] = {0.6f, 0.6f, 0.6f};
  CHECK(count_specks(page, page.light()) == 0);
  // What is dark all around is not seen.
  for (Rgb& c : page.light()) c = {0.002f, 0.002f, 0.002f};
  page.light()[page.at(10, 8)] = {};
  CHECK(count_specks(page, page.light()) == 0);
}

TEST_CASE("seams: a side that lies within something draws nothing") {
  const int n = 16;
  std::vector<Rgb> texels(n * n);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < 8; ++x) texels[y * n + x] = {1, 1, 1};
  const std::vector<Seam> seams{{{0, {{4, 2}, {4, 14}}}, {0, {{12, 2}, {12, 14}}}}};
  Canvas page{n, n, texels};
  CHECK(close_seams({&page, 1}, seams).places == 24);
  CHECK(page.texels[8 * n + 4].r < 0.9f);
  page = {n, n, texels, std::vector<char>(n * n)};
  for (int y = 0; y < 8; ++y)
    for (int x = 8; x < n; ++x) page.inside[y * n + x] = 1;
  const SeamReport report = close_seams({&page, 1}, seams);
  CHECK(report.places == 12);
  CHECK(page.texels[5 * n + 4].r == 1);
  CHECK(page.texels[11 * n + 4].r < 0.9f);
}

TEST_CASE("seams: both sides show the same, by small changes, and nothing else moves") {
  const int n = 32;
  std::vector<Rgb> texels(n * n);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) texels[y * n + x] = x < 16 ? Rgb{1, 1, 1} : Rgb{1.2f, 1.2f, 1.2f};
  // The right border of one chart and a slanted line in the other.
  std::vector<Seam> seams{{{0, {{10.3f, 4}, {10.3f, 20}}}, {0, {{22.2f, 5}, {24.7f, 20.6f}}}}};
  Canvas page{n, n, texels};
  close_seams({&page, 1}, seams);
  texels = page.texels;
  for (float t = 0.05f; t < 1; t += 0.1f) {
    float a = shown(texels, n, 10.3f, 4 + 16 * t), b = shown(texels, n, 22.2f + 2.5f * t, 5 + 15.6f * t);
    CHECK(a == Approx(b).margin(0.02));
    CHECK(a > 1.05f);
    CHECK(a < 1.15f);
  }
  CHECK(texels[2 * n + 2].r == 1);
  CHECK(texels[30 * n + 30].r == 1.2f);
}
