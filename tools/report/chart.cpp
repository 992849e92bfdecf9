#include "tools/report/chart.h"
#include "base/text/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace wrlkit {
namespace {

constexpr double width = 460, height = 300, left = 54, right = 446, top = 14, bottom = 258;

/// A logarithmic axis from one place of the picture to another, and where its marks are: at 1, 2 and 5 of each decade
/// while that are few, otherwise at the powers of ten.
class Axis {
 public:
  Axis(double low, double high, double from, double to)
      : low_(std::log10(low)), high_(std::log10(high)), from_(from), to_(to) {
    if (high_ - low_ < 0.3) {
      low_ -= 0.15;
      high_ += 0.15;
    }
  }

  double operator()(double v) const {
    return from_ + (to_ - from_) * std::clamp((log_of(v) - low_) / (high_ - low_), 0.0, 1.0);
  }

  std::vector<double> marks() const {
    const bool few = high_ - low_ < 2.5;
    std::vector<double> out;
    for (int e = static_cast<int>(std::floor(low_)); e <= high_; ++e)
      for (double m : {1.0, 2.0, 5.0}) {
        const double l = e + std::log10(m);
        if ((few || m == 1) && l >= low_ - 1e-9 && l <= high_ + 1e-9) out.push_back(m * std::pow(10.0, e));
      }
    return out;
  }

 private:
  double log_of(double v) const { return v > 0 ? std::log10(v) : low_; }
  double low_, high_, from_, to_;
};

Axis axis_over(const std::vector<ChartSeries>& series, double ChartPoint::*value, double from, double to) {
  constexpr double most_decades = 1e5;
  double low = 0, high = 0;
  for (const auto& s : series)
    for (const auto& p : s.points) high = std::max(high, p.*value);
  low = high;
  for (const auto& s : series)
    for (const auto& p : s.points)
      if (p.*value > high / most_decades) low = std::min(low, p.*value);
  return high > 0 ? Axis(low, high, from, to) : Axis(0.1, 1, from, to);
}

/// Circle, square, diamond, triangle up, triangle down, round and round.
std::string mark_at(double x, double y, std::size_t k, std::string_view title) {
  constexpr std::string_view shapes[] = {"m-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z", "m-3.5-3.5h7v7h-7z", "m0-5l5 5-5 5-5-5z",
                                         "m0-4.5l4.5 8h-9z", "m0 4.5l4.5-8h-9z"};
  return fmt::format(R"(<path class="mark s{}" d="M{:.1f} {:.1f}{}">{}</path>)", k, x, y, shapes[k % std::size(shapes)],
                     title.empty() ? "" : fmt::format("<title>{}</title>", xml_text(title)));
}

std::string grid(const Axis& x, const Axis& y) {
  std::string out;
  auto at = std::back_inserter(out);
  for (double v : x.marks())
    fmt::format_to(
        at, R"(<path class="grid" d="M{0:.1f} {1}V{2}"/><text x="{0:.1f}" y="{3}" text-anchor="middle">{4:.6g}</text>)",
        x(v), top, bottom, bottom + 16, v);
  for (double v : y.marks())
    fmt::format_to(
        at, R"(<path class="grid" d="M{1} {0:.1f}H{2}"/><text x="{3}" y="{4:.1f}" text-anchor="end">{5:.3g}</text>)",
        y(v), left, right, left - 6, y(v) + 4, v);
  fmt::format_to(at,
                 R"(<path class="axis" d="M{0} {1}V{2}H{3}"/><text x="{3}" y="{4}" text-anchor="end">triangles</text>)",
                 left, top, bottom, right, bottom + 34);
  return out;
}

std::string line(const ChartSeries& s, std::size_t k, const Axis& x, const Axis& y, std::string_view unit) {
  std::string path, marks;
  for (const auto& p : s.points) {
    fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x(p.x), y(p.y));
    marks += mark_at(x(p.x), y(p.y), k, fmt::format("{}: {:.3g} {} at {:.0f} triangles", s.name, p.y, unit, p.x));
  }
  return path.empty() ? path : fmt::format("<path class=\"line s{}\" d=\"{}\"/>{}\n", k, path, marks);
}

}  // namespace

std::string log_chart(std::string_view title, std::string_view unit, const std::vector<ChartSeries>& series) {
  const Axis x = axis_over(series, &ChartPoint::x, left + 8, right - 8),
             y = axis_over(series, &ChartPoint::y, bottom - 8, top + 8);
  std::string out = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n{}\n", width, height,
                                xml_text(title), grid(x, y));
  for (std::size_t k = 0; k < series.size(); ++k) out += line(series[k], k, x, y, unit);
  return out + "</svg>\n";
}

std::string chart_mark(std::size_t k) {
  return fmt::format(R"(<svg class="key" viewBox="0 0 12 12" aria-hidden="true">{}</svg>)", mark_at(6, 6, k, ""));
}

}  // namespace wrlkit
