#include "convert/expanded_copy.h"

#include "passes/expand/expand.h"
#include "passes/lower_vrml1/lower_vrml1.h"

namespace wrlkit {
namespace {

/// The files that Inlines name, read once: their faults are reported to whoever asks first.
class InlinedFiles final : public Resources {
 public:
  InlinedFiles(Resources& files, Diagnostics& diag, const Scene& original, const Scene& copy)
      : files_(files), diag_(diag), original_(original), copy_(copy) {}

  /// A scene that contains itself is known by its address.
  LinkedWorld world(std::span<const std::string_view> urls, Span where, Diagnostics&) override {
    auto found = files_.world(urls, where, diag_);
    if (found.scene.get() == &original_) found.scene = {std::shared_ptr<const Scene>{}, &copy_};
    return found;
  }
  std::shared_ptr<const Blob> bytes(std::span<const std::string_view>, Span, Diagnostics&) override { return nullptr; }
  std::shared_ptr<const Image> image(std::span<const std::string_view>, Span, Diagnostics&) override { return nullptr; }

 private:
  Resources& files_;
  Diagnostics& diag_;
  const Scene& original_;
  const Scene& copy_;
};

}  // namespace

Scene expanded_copy(const Scene& scene, Resources* files, Diagnostics& diag) {
  Scene out = scene;
  Diagnostics unheard(diag.shared_sources());
  Statistics uncounted;
  PassContext silent(unheard, uncounted);
  lower_vrml1(out, {}, silent);
  if (!files) {
    expand_protos(out, {}, silent);
    return out;
  }
  InlinedFiles inlined(*files, diag, scene, out);
  silent.resources = &inlined;
  expand(out, {}, silent);
  return out;
}

}  // namespace wrlkit
