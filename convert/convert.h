// From one file to another: what `wrlkit convert` does.
#pragma once
#include <string>
#include <vector>

#include "convert/save.h"

namespace wrlkit {

struct ConvertOptions {
  LoadOptions load;
  SaveOptions save;
};

struct Converted : Saved {
  std::vector<MessageView> messages = {};  // of reading and of writing
};

/// Reads `from`, prepares the scene for the format that the name of `to` says, and writes it, whole or not at all.
///
///   const auto done = wrlkit::convert("pump.wrl", "pump.glb", {.save = {.compress =
///   GltfCompression::Method::meshopt}}); if (!done)
///     for (const auto& message : done.messages) std::cerr << message.str() << '\n';
Converted convert(const std::string& from, const std::string& to, const ConvertOptions& = {}, Watch watch = {});

/// Whether a document that was read is worth converting: checks its values against the node table, and reports when
/// nothing is left of a faulty file.
bool check_input(Document&);

}  // namespace wrlkit
