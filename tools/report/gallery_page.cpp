#include "tools/report/gallery_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "base/io/read_file.h"
#include "base/text/xml_text.h"
#include "tools/report/report_frame.h"

namespace wrlkit {
namespace {

std::string counted(std::uint64_t n, std::string_view one) { return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s"); }

std::string messages_text(const GalleryWorld& w) {
  std::string out;
  if (w.errors > 0) out += fmt::format("<span class=\"bad\">{}</span>", counted(w.errors, "error"));
  if (w.warnings > 0) out += (out.empty() ? "" : ", ") + counted(w.warnings, "warning");
  if (w.lost > 0) out += fmt::format("{}{} lost", out.empty() ? "" : ", ", w.lost);
  return out.empty() ? "no messages" : fmt::format("{}: {}", out, fmt::join(w.messages, ", "));
}

std::string picture_text(const Gallery& g, const GalleryWorld& w) {
  if (w.picture.empty())
    return fmt::format("<div class=\"none{}\">{}</div>", w.fault.empty() ? "" : " bad",
                       w.fault.empty() ? "no picture" : xml_text(w.fault));
  return fmt::format(
      "<img width=\"{}\" height=\"{}\" loading=\"lazy\" decoding=\"async\" alt=\"\" "
      "src=\"data:image/jpeg;base64,{}\">",
      g.width, g.height, w.picture);
}

std::string world_text(const Gallery& g, const GalleryWorld& w) {
  const auto messages = w.errors + w.warnings + w.lost;
  std::string out =
      fmt::format("<li data-name=\"{}\" data-triangles=\"{}\" data-bytes=\"{}\" data-messages=\"{}\">{}\n",
                  xml_text(w.name), w.triangles, w.bytes, messages, picture_text(g, w));
  out += fmt::format("<a href=\"{}\">{}</a><br>\n", xml_text(w.link), xml_text(w.name));
  if (w.fault.empty()) out += fmt::format("{}, {}, ", counted(w.triangles, "triangle"), counted(w.parts, "part"));
  out += fmt::format("{}<br>\n<span class=\"soft\">{}</span></li>\n", readable_size(w.bytes), messages_text(w));
  return out;
}

constexpr std::string_view controls =
    "<div class=\"line\"><label>Search <input type=\"search\" id=\"q\"></label>\n"
    "<label>Order <select id=\"by\"><option value=\"name\">by name</option>"
    "<option value=\"triangles\">most triangles</option><option value=\"bytes\">most bytes</option>"
    "<option value=\"messages\">most messages</option></select></label>\n"
    "<output id=\"n\"></output></div>\n";

}  // namespace

std::string gallery_page(const Gallery& g) {
  std::string out = report_begin(g.title);
  out += controls;
  if (g.n_left_out > 0)
    out += fmt::format("<p class=\"bad\">{} left out (--limit).</p>\n",
                       g.n_left_out == 1 ? "1 more world is" : fmt::format("{} more worlds are", g.n_left_out));
  out += "<ul class=\"gallery\" id=\"worlds\">\n";
  for (const auto& w : g.worlds) out += world_text(g, w);
  out += fmt::format("</ul>\n<script>\n{}</script>\n", gallery_script());
  return out + report_end();
}

}  // namespace wrlkit
