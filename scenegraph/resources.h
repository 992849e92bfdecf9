// What a world refers to: pictures, other worlds, bytes. The interface through which passes and writers reach them; the
// implementation (parsers/resources.h) reads files below the allowed folders and nothing else.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/diagnostics.h"
#include "scenegraph/image.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// A file as it is: what glTF embeds without touching it.
struct Blob {
  std::string name;   // file name without folder
  std::string bytes;
  std::string_view mime;  // "image/png", "image/jpeg", ... by magic bytes; empty: unknown
};

class Resources {
 public:
  virtual ~Resources() = default;

  /// The first of the urls that can be had, for a node that was read at `where` (relative urls are relative to that file).
  /// Reports and returns null when none can. Each file is read once; later calls return the same object.
  virtual std::shared_ptr<const Blob> bytes(std::span<const std::string_view> urls, Span where, Diagnostics&) = 0;
  virtual std::shared_ptr<const Image> image(std::span<const std::string_view> urls, Span where, Diagnostics&) = 0;
  virtual std::shared_ptr<const Scene> world(std::span<const std::string_view> urls, Span where, Diagnostics&) = 0;
};

}  // namespace wrlkit
