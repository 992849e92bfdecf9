// From a document to a file or to bytes.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "convert/document.h"
#include "convert/formats.h"
#include "passes/pipeline/pipeline.h"
#include "writers/gltf/gltf.h"

namespace wrlkit {

/// The outcome. Messages are in the document's messages.
struct Saved {
  Ending ending = Ending::failed;
  std::optional<GltfSummary> gltf = {};  // of glTF

  /// Whether there is an output.
  explicit operator bool() const { return ending == Ending::good || ending == Ending::partly; }
};

/// Writes a document; the ending of the name decides the format ("-": a .glb to standard output). The file is written
/// whole or not at all. What the format needs is done to a copy, so that the document stays what it was. A scene that
/// breaks what `verify` checks (scenegraph/verify.h) is not written.
Saved save(const Document&, const std::string& path, const SaveOptions& = {});
/// The same, without the copy: the document holds what was written.
Saved save(Document&&, const std::string& path, const SaveOptions& = {});
/// The same into memory, piece by piece; `ending` says the format: ".glb", ".wrl", ".x3d". Pictures that passes have
/// made are inside what is written; others of VRML and X3D stay where the document has them (SaveOptions::embed:
/// inside, too). What the Sink throws comes out here; the document stays what it was then, too.
Saved save(const Document&, const Sink&, const std::string& ending, const SaveOptions& = {});

/// What the command line may want to see of it.
struct SaveHooks {
  PipelineOptions pipeline = {};
  std::function<void(Scene&)> last = {};  // is given the scene of a text format before it is written
};

/// SaveOptions::pipeline with what the format needs. Nothing when it is not a pipeline; `why` says what is wrong.
std::optional<Pipeline> pipeline_for(const Output&, const SaveOptions&, std::string& why);
/// Runs the pipeline on the document's own scene and writes what comes out.
Saved write_document(Document&, Pipeline&, const Output&, const SaveOptions&, const SaveHooks& = {});

}  // namespace wrlkit
