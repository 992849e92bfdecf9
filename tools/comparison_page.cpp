// The page of compare-lod.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

#include "scenegraph/base64.h"
#include "tools/chart.h"
#include "tools/comparison.h"

namespace wrlkit {
namespace {

constexpr std::string_view page_style =
    ":root{--page:#fff;--ink:#1b1f24;--soft:#59636e;--rule:#dde2e7}"
    "@media(prefers-color-scheme:dark){:root{--page:#14181d;--ink:#e8ecf0;--soft:#9aa5b1;--rule:#2d343c}}"
    "body{background:var(--page);color:var(--ink);font:16px/1.5 system-ui,sans-serif;max-width:1060px;margin:0 auto;padding:16px}"
    "h1{font-size:1.5rem;overflow-wrap:anywhere}h2{font-size:1.15rem;margin-top:2rem}p{max-width:46em}"
    ".charts{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,420px),1fr));gap:20px}"
    ".pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(150px,1fr));gap:12px}"
    "figure{margin:0;min-width:0}figcaption{color:var(--soft);font-size:.85rem}figure b{color:var(--ink);font-weight:600}"
    "img{width:100%;height:auto;display:block;border:1px solid var(--rule);box-sizing:border-box}.model{max-width:420px}"
    ".keys{list-style:none;padding:0;display:flex;flex-wrap:wrap;gap:4px 18px}.key{width:.8em;margin-right:.4em}"
    ".scroll{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.9rem}"
    "td,th{padding:3px 14px 3px 0;text-align:right;white-space:nowrap;border-bottom:1px solid var(--rule)}td:first-child,th:first-child{text-align:left}"
    "th{font-weight:600;color:var(--soft)}";

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

class Page {
 public:
  explicit Page(const Comparison& c) : c_(c) {}

  std::optional<std::string> write(std::string& why) {
    head();
    charts();
    pictures();
    figures();
    out_ += "</body></html>\n";
    why = why_;
    return why_.empty() ? std::optional(std::move(out_)) : std::nullopt;
  }

 private:
  template <class... T>
  void put(fmt::format_string<T...> format, T&&... values) { fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...); }

  void head() {
    const auto model = html_text(c_.model);
    put("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
        "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{} simplified</title>\n<style>{}{}</style></head>\n<body>\n", model, page_style, chart_style);
    put("<h1>{} simplified</h1>\n<p>{} triangles, fewer and fewer by each criterion.</p>\n", model, c_.n_faces);
    picture(c_.picture, "model", fmt::format("<b>the model</b>, {} triangles", c_.n_faces));
  }

  void picture(const Image& image, std::string_view css, std::string_view caption) {
    auto png = encode_png(image, why_);
    if (png) put("<figure class=\"{}\"><img width=\"{}\" height=\"{}\" alt=\"\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n", css, image.width, image.height, base64(*png), caption);
  }

  void charts() {
    put("<h2>How far, how fast</h2>\n<p>Distances are measured from both surfaces to the other, in the unit of the geometry. What is "
        "lower is better; what lies on the lower edge is less than can be shown. Time is of the processor, for the collapses from the model on.</p>\n<ul class=\"keys\">");
    for (std::size_t k = 0; k < c_.criteria.size(); ++k) put("<li>{}{}</li>", chart_mark(k), html_text(c_.criteria[k].name));
    put("</ul>\n<div class=\"charts\">\n");
    chart("Distance, root of the mean square", "", [](const InteractionPoint& p) { return p.rms; });
    chart("Distance, largest", "", [](const InteractionPoint& p) { return p.error; });
    chart("Angle between normals, mean, in degrees", "degrees", [](const InteractionPoint& p) { return degrees(p.normals); });
    chart("Time, in seconds", "s", [](const InteractionPoint& p) { return p.seconds; });
    put("</div>\n");
  }

  void chart(std::string_view title, std::string_view unit, auto&& value) {
    std::vector<ChartSeries> series;
    for (const auto& criterion : c_.criteria) {
      auto& s = series.emplace_back(ChartSeries{criterion.name, {}});
      for (const auto& p : criterion.points)
        if (p.n_faces > 0 && p.n_faces < c_.n_faces && std::isfinite(value(p))) s.points.push_back({static_cast<double>(p.n_faces), value(p)});
    }
    put("<figure><figcaption><b>{}</b></figcaption>\n{}</figure>\n", title, log_chart(title, unit, series));
  }

  void pictures() {
    put("<h2>How it looks</h2>\n");
    for (std::size_t i = 0; i < c_.counts.size(); ++i) {
      put("<h3>{} triangles</h3>\n<div class=\"pictures\">\n", c_.counts[i]);
      for (const auto& criterion : c_.criteria)
        if (i < criterion.points.size()) {
          const auto& p = criterion.points[i];
          picture(criterion.pictures[i], "", fmt::format("<b>{}</b>, {} triangles, rms {:.3g}", html_text(criterion.name), p.n_faces, p.rms));
        }
      put("</div>\n");
    }
  }

  void figures() {
    put("<h2>Figures</h2>\n<div class=\"scroll\"><table>\n<tr><th>criterion</th><th>triangles</th><th>rms</th><th>max</th><th>normals, degrees</th><th>seconds</th></tr>\n");
    for (const auto& criterion : c_.criteria)
      for (const auto& p : criterion.points)
        put("<tr><td>{}</td><td>{}</td><td>{:.3g}</td><td>{:.3g}</td><td>{:.2g}</td><td>{:.3f}</td></tr>\n", html_text(criterion.name), p.n_faces, p.rms, p.error, degrees(p.normals), p.seconds);
    put("</table></div>\n");
  }

  const Comparison& c_;
  std::string out_, why_;
};

}  // namespace

std::optional<std::string> comparison_page(const Comparison& c, std::string& why) { return Page(c).write(why); }

}  // namespace wrlkit
