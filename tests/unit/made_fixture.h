// What tests of documents need that no file was read for.
#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/io/url.h"
#include "convert/wrlkit.h"
#include "scenegraph/nodes.h"
#include "tests/unit/temp_folder.h"

namespace wrlkit {

/// The current folder, for the time of a test.
class InFolder {
 public:
  explicit InFolder(const std::filesystem::path& folder) : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  ~InFolder() { std::filesystem::current_path(before_); }
  InFolder(const InFolder&) = delete;

 private:
  std::filesystem::path before_;
};

/// A PNG of one pixel.
inline std::string pixel() {
  return *decode_data_url(
      "data:image/"
      "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg"
      "==");
}

inline std::string bytes_of(const Document& document, const std::string& ending, const SaveOptions& options = {}) {
  std::string bytes;
  const auto saved = save(
      document, [&](std::string_view piece) { bytes += piece; }, ending, options);
  return saved ? bytes : std::string();
}

inline bool has_message(const Document& document, std::string_view name) {
  return std::ranges::any_of(document.messages(), [&](const MessageView& m) { return m.name == name; });
}

inline constexpr auto refers = R"(#VRML V2.0 utf8
EXTERNPROTO Kept [ ] [ "kept.wrl#Kept" ]
Inline { url "part.wrl" }
Kept { }
Shape {
  appearance Appearance { texture ImageTexture { url "pixel.png" } }
  geometry Box { }
})";

/// What the bytes above refer to.
struct Parts {
  TempFolder folder;
  Parts() {
    folder.write("part.wrl", "#VRML V2.0 utf8\nDEF FromPart Shape { geometry Sphere { } }");
    folder.write("kept.wrl", "#VRML V2.0 utf8\nPROTO Kept [ ] { Group { children DEF FromKept Group { } } }");
    folder.write("pixel.png", pixel());
  }
};

/// A box that a program has made.
struct Made {
  World world;
  NodeId shape, box, group;
  Scene& scene = world.scene;

  Made() {
    group = scene.add(nodes::Transform);
    shape = scene.add(nodes::Shape);
    box = scene.add(nodes::Box);
    scene.set(shape, nodes::shape::geometry, box);
    scene.set(group, nodes::transform::children, std::vector{shape});
    scene.main.roots = {group};
  }
  Document document() { return Document(World{.scene = scene}); }
};

}  // namespace wrlkit
