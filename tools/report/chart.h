// Line charts as SVG text for an HTML page: both axes logarithmic, as errors over numbers of triangles want
// it.
//
// Colours, lines and letters are the page's business: their style is in tools/report/report.css. Series k of every
// chart has the class `s<k>`, and a shape of its own at its points, for eyes that cannot tell the colours. Each point
// shows its numbers when it is pointed at.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

struct ChartPoint {
  double x, y;
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;
};

/// The chart as an <svg> element. Coordinates are finite, x is positive. Values of y that are not, or are a hundred
/// thousand times smaller than the largest, lie on the lower edge.
std::string log_chart(std::string_view title, std::string_view unit, const std::vector<ChartSeries>& series);

/// The mark of series k as a small <svg> element: for a legend.
std::string chart_mark(std::size_t k);

}  // namespace wrlkit
