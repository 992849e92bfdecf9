#include "tools/corpus/look.h"

#include <filesystem>
#include <limits>

#include "base/image/image.h"
#include "base/io/read_file.h"
#include "base/text/base64.h"
#include "base/text/json.h"
#include "base/text/json_reader.h"
#include "convert/diff.h"
#include "light/render/render.h"
#include "tools/cli/session.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr int thumbnail_width = 160, thumbnail_height = 120, quality = 80;
constexpr std::uint64_t most_bytes = 1 << 20;

/// A picture from the given place, or from the world's own, which is then the place for the next.
std::string picture(Session& s, const std::string& path, RenderOptions& place) {
  if (!s.choose_pipeline("picture") || !s.read(path)) return "";
  const auto meshes = s.pipeline().run_lazily(s.world().scene, s.context(), s.pipeline_options());
  if (!meshes) return "";
  if (!place.look_at) place = with_camera(s.world().scene, meshes, place, s.diag());
  std::string why;
  const auto bytes = encode_jpeg(render(s.world().scene, meshes, place, &s.resources(), s.diag()), quality, why);
  return bytes ? base64(*bytes) : "";
}

/// Flags to read one of the two scenes with.
Flags flags_to_read(const Flags& flags, const std::string& path, bool input) {
  Flags f;
  f.quiet = true;
  f.jobs = 1;
  f.inputs = {path};
  f.load.allow_paths = flags.load.allow_paths;
  if (input) {
    f.load.unit = flags.load.unit;
    f.load.up = flags.load.up;
  }
  return f;
}

}  // namespace

std::string look_file(const std::string& out, const JournalLine& line) {
  return corpus_folder(out) + "/looks/" +
         hash_of(line.input_hash.hex() + line.output_hash.hex() + line.work.hex() + line.output).hex() + ".json";
}

bool make_look(const Flags& flags, const std::string& out, const JournalLine& line) {
  const auto output = (fs::path(out) / line.output).string();
  const Flags of_input = flags_to_read(flags, line.input, true);
  Flags of_output = flags_to_read(flags, output, false);
  of_output.load.allow_paths.push_back(out);
  Session a(of_input), b(of_output);
  if (!a.read(line.input) || !b.read(output)) return false;
  auto facts_a = facts_of(std::move(a.document()), false);
  auto facts_b = facts_of(std::move(b.document()), false);
  if (!facts_a || !facts_b) return false;
  const auto d = difference(std::move(*facts_a), std::move(*facts_b));
  constexpr double none = std::numeric_limits<double>::infinity();
  const bool both_empty = d.a.geometry.triangles == 0 && d.b.geometry.triangles == 0;
  RenderOptions place{.width = thumbnail_width, .height = thumbnail_height, .samples = 2};
  Session before(of_input), after(of_output);
  std::string text;
  JsonOut json(text);
  json.object([&] {
    json.member("rms", both_empty ? 0 : d.surface ? d.surface->rms : none);
    json.member("max", both_empty ? 0 : d.surface ? d.surface->max : none);
    json.member("of_diagonal", both_empty ? 0 : d.surface ? d.of_diagonal : none);
    json.member("before", picture(before, line.input, place));
    json.member("after", picture(after, output, place));
  });
  return write_text_file(look_file(out, line), text + "\n");
}

std::optional<Look> read_look(const std::string& path) {
  std::string why;
  const auto text = read_bytes(path, most_bytes, why);
  JsonDocument doc;
  if (!text || doc.parse(*text)) return std::nullopt;
  const auto json = doc.root();
  constexpr double none = std::numeric_limits<double>::infinity();
  return Look{json["rms"].number(none), json["max"].number(none), json["of_diagonal"].number(none),
              std::string(json["before"].text()), std::string(json["after"].text())};
}

}  // namespace wrlkit
