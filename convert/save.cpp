#include "convert/save.h"

#include "convert/emptied.h"
#include "convert/kept_made.h"
#include "convert/missing_files.h"
#include "convert/writing.h"
#include "scenegraph/repair.h"
#include "scenegraph/verify.h"

namespace wrlkit {
namespace {

constexpr auto no_scene = "there is no scene";

Saved failed(const Document& document, const std::string& path, const std::string& why) {
  document.diag().report(Diag::cannot_write, {}, path, why);
  return {};
}

bool run_and_write(Document& document, Pipeline& pipeline, const Output& to, const SaveOptions& options,
                   const SaveHooks& hooks, const Sink* sink, Saved& saved) {
  Scene& scene = document.scene();
  PassContext& ctx = document.context();
  const bool is_checked = !sink && !options.dump && ctx.resources;
  MeshSource meshes;
  MeshMakers makers;
  if (to.format->meshes) {
    meshes = pipeline.run_lazily(scene, ctx, hooks.pipeline, &makers);
    if (!meshes) return false;
  } else {
    const EmptiedScene emptied(scene);
    if (!pipeline.run(scene, ctx, hooks.pipeline)) return false;
    emptied.report(scene, ctx.diag);
    if (is_checked && to.path != "-") report_missing_parts(scene, *ctx.resources, ctx.diag);
    if (is_checked && to.path == "-") report_missing_pictures(scene, *ctx.resources, ctx.diag);
  }
  if (hooks.last) hooks.last(scene);
  if (is_checked && (to.path != "-" || to.format->meshes)) report_missing_media(scene, *ctx.resources, ctx.diag);
  return to.format->write({scene, meshes, ctx, options, to, sink, saved, makers});
}

Saved write_to(Document& document, Pipeline& pipeline, const Output& to, const SaveOptions& options,
               const SaveHooks& hooks, const Sink* sink) {
  Saved saved;
  const bool made = run_and_write(document, pipeline, to, options, hooks, sink, saved);
  saved.ending = document.ending(made);
  return saved;
}

Saved save_to(Document&& document, const std::string& path, const SaveOptions& options, const Sink* sink) {
  const auto to = output_of(path, options);
  if (!to) return failed(document, path, "its name should end in " + output_endings_text());
  if (sink && to->format->endings == ".gltf")
    return failed(document, path, "what is written to memory has no files next to it; choose .glb");
  if (!verify(document.scene(), Level::authored, document.diag())) return {};
  repair_values(document.scene(), document.diag());
  std::string why;
  auto pipeline = pipeline_for(*to, options, why);
  if (!pipeline) return failed(document, path, why);
  return write_to(document, *pipeline, *to, options, {}, sink);
}

}  // namespace

std::optional<Pipeline> pipeline_for(const Output& to, const SaveOptions& options, std::string& why) {
  const auto standard = to.format->pipeline(options);
  auto pipeline = Pipeline::parse(options.pipeline ? *options.pipeline : standard, why);
  if (pipeline && options.pipeline) pipeline->complete(standard);
  return pipeline;
}

Saved write_document(Document& document, Pipeline& pipeline, const Output& to, const SaveOptions& options,
                     const SaveHooks& hooks) {
  return write_to(document, pipeline, to, options, hooks, nullptr);
}

Saved save(const Document& document, const std::string& path, const SaveOptions& options) {
  if (!document) return failed(document, path, no_scene);
  const KeptMade kept(document.resources());
  return save_to(document.copy(), path, options, nullptr);
}

Saved save(Document&& document, const std::string& path, const SaveOptions& options) {
  if (!document) return failed(document, path, no_scene);
  return save_to(std::move(document), path, options, nullptr);
}

Saved save(const Document& document, const Sink& sink, const std::string& ending, const SaveOptions& options) {
  if (!document) return failed(document, ending, no_scene);
  const KeptMade kept(document.resources());
  return save_to(document.copy(), ending, options, &sink);
}

}  // namespace wrlkit
