#include "tools/report/report_frame.h"

#include <fmt/format.h>

#include "tools/report/chart.h"

extern "C" const char wrlkit_style_begin[], wrlkit_style_end[];  // tools/report/style.S

namespace wrlkit {
namespace {

std::string_view style() {
  return {wrlkit_style_begin, static_cast<std::size_t>(wrlkit_style_end - wrlkit_style_begin)};
}

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
      html_text(title), style());
}

std::string_view report_end() {
  return R"HTML(</main>
<script>
{
  const root = document.documentElement, button = document.getElementById("theme");
  const dark = () => root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  const say = () => { button.textContent = dark() ? "Light" : "Dark"; };
  button.onclick = () => { root.dataset.theme = dark() ? "light" : "dark"; say(); };
  say();
}
</script>
</body></html>
)HTML";
}

std::string table_begin(std::string_view name) {
  return fmt::format("<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table>\n",
                     html_text(name));
}

std::string_view table_end() { return "</table></div>\n"; }

}  // namespace wrlkit
