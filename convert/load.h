// From a file or from bytes to a document.
#pragma once
#include "convert/document.h"

namespace wrlkit {

/// Reads a file; "-" is standard input. Its first bytes decide the format, and whether it is gzipped. False as a bool
/// when no scene could be read: messages() say why.
///
///   wrlkit::Document world = wrlkit::load("pump.wrl");
///   if (!world)
///     for (const auto& message : world.messages()) std::cerr << message.str() << '\n';
Document load(const std::string& path, LoadOptions options = {}, Watch watch = {});
/// The same from memory, not gzipped; `name` is for messages. Bytes have no folder: no file is read but below
/// LoadOptions::allow_paths, and relative urls are looked for in each of these.
Document load_bytes(std::string_view bytes, std::string name, LoadOptions options = {}, Watch watch = {});

}  // namespace wrlkit
