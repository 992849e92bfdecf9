#include "tools/report/report_frame.h"
#include "base/text/xml_text.h"

#include <fmt/format.h>

#include "tools/report/chart.h"

// tools/report/assets.S
extern "C" const char wrlkit_style_begin[], wrlkit_style_end[];
extern "C" const char wrlkit_theme_begin[], wrlkit_theme_end[];
extern "C" const char wrlkit_corpus_table_begin[], wrlkit_corpus_table_end[];
extern "C" const char wrlkit_gallery_begin[], wrlkit_gallery_end[];

namespace wrlkit {
namespace {

std::string_view asset(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

}  // namespace

std::string report_begin(std::string_view title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data:\">\n"
      "<link rel=\"icon\" href=\"data:,\"><title>{0}: wrlkit</title>\n<style>\n{1}</style></head>\n"
      "<body>\n<header class=\"head\"><h1>{0}</h1><div class=\"tools\"><button type=\"button\" "
      "id=\"theme\">Dark</button></div></header>\n<main>\n",
      xml_text(title), asset(wrlkit_style_begin, wrlkit_style_end));
}

std::string report_end() {
  return fmt::format("</main>\n<script>\n{}</script>\n</body></html>\n", asset(wrlkit_theme_begin, wrlkit_theme_end));
}

std::string_view corpus_table_script() { return asset(wrlkit_corpus_table_begin, wrlkit_corpus_table_end); }

std::string_view gallery_script() { return asset(wrlkit_gallery_begin, wrlkit_gallery_end); }

std::string table_begin(std::string_view name) {
  return fmt::format("<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table>\n",
                     xml_text(name));
}

std::string_view table_end() { return "</table></div>\n"; }

}  // namespace wrlkit
