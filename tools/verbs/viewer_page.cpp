#include "tools/verbs/viewer_page.h"

#include <fmt/format.h>

#include <functional>

#include "base/io/gzip.h"
#include "base/text/base64.h"
#include "base/text/json.h"

#ifdef WRLKIT_VIEWER
// tools/verbs/viewer_template.S
extern "C" const char wrlkit_viewer_begin[], wrlkit_viewer_end[], wrlkit_tiles_begin[], wrlkit_tiles_end[];
#endif

namespace wrlkit {
namespace {

/// The viewer without scenes.
std::string_view page_template() {
#ifdef WRLKIT_VIEWER
  return {wrlkit_viewer_begin, static_cast<std::size_t>(wrlkit_viewer_end - wrlkit_viewer_begin)};
#else
  return {};
#endif
}

/// The same for a tileset.
std::string_view tiles_template() {
#ifdef WRLKIT_VIEWER
  return {wrlkit_tiles_begin, static_cast<std::size_t>(wrlkit_tiles_end - wrlkit_tiles_begin)};
#else
  return {};
#endif
}

constexpr std::string_view mark = "<!--wrlkit-->";  // where the scenes go

class Files {
 public:
  explicit Files(const Sink& sink) : sink_(sink) {}

  /// The number by which the page finds it.
  std::size_t add(std::string_view bytes) {
    sink_(fmt::format(R"(<script type="text/plain" id="file-{}">)", n_));
    sink_(base64(gzipped(bytes)));
    sink_("</script>\n");
    return n_++;
  }

 private:
  const Sink& sink_;
  std::size_t n_ = 0;
};

/// In a script element nothing may look like its end.
std::string without_tags(std::string json) {
  for (std::size_t i = 0; (i = json.find('<', i)) != json.npos;) json.replace(i, 1, "\\u003c");
  return json;
}

void write_contents(std::string json, const Sink& sink) {
  sink(R"(<script type="application/json" id="contents">)");
  sink(without_tags(std::move(json)));
  sink("</script>\n");
}

void write_apart(const ViewerPage::Apart& apart, Files& files, JsonOut& json) {
  const auto& d = apart.deviation;
  json.object("deviation", [&] {
    json.members("rms", d.rms, "max", d.max, "where", std::span(d.where));
    json.list("sides", std::array{0, 1}, [&](std::size_t side) {
      const auto& one = side == 0 ? d.forward : d.backward;
      json.object("rms", one.rms, "max", one.max, "where", std::span(one.where), "file", files.add(apart.maps[side]));
    });
  });
}

void write_data(const ViewerPage& page, const Sink& sink) {
  Files files(sink);
  write_contents(json_text([&](JsonOut& json) {
                   json.object([&] {
                     json.list("worlds", page.worlds, [&](const auto& world) {
                       json.object("name", world.name, "file", files.add(world.glb));
                     });
                     json.list("collapses", page.collapses, [&](const auto& collapse) {
                       json.object("criterion", collapse.criterion, "file", files.add(collapse.wpm));
                     });
                     if (page.apart) write_apart(*page.apart, files, json);
                   });
                 }),
                 sink);
}

/// A page, with what `write_middle` writes where its mark is.
void write_filled(std::string_view html, const std::function<void()>& write_middle, const Sink& sink) {
  const auto at = html.find(mark);
  sink(html.substr(0, at));
  write_middle();
  sink(html.substr(at + mark.size()));
}

}  // namespace

bool has_viewer() { return !page_template().empty(); }

void write_viewer_page(const ViewerPage& page, const Sink& sink) {
  write_filled(
      page_template(), [&] { write_data(page, sink); }, sink);
}

void write_tiles_page(const std::string& name, const std::string& tileset, const Sink& sink) {
  write_filled(
      tiles_template(), [&] { write_contents(json_of(json_object("name", name, "tileset", tileset)), sink); }, sink);
}

}  // namespace wrlkit
