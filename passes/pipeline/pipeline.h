// Pipelines: passes by name, in text form, and how they are run.
//
//   inline,expand-protos,tessellate{tolerance=0.005},normals
//
// Neighbouring mesh passes are run together on one geometry after the other. When a writer follows, the last such group
// is not run at all until the writer asks for a mesh, so that the meshes of a plant never lie in memory all together.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "passes/pipeline/pass.h"

namespace wrlkit {

/// One option of a pass as text: what `passes`, --print-pipeline and the docs show.
struct OptionInfo {
  std::string name, type, value, help;
  std::string range;  // of a number: "0 to 1", "at least 0"; empty: any

  /// "number at least 0".
  std::string type_and_range() const { return range.empty() ? type : type + " " + range; }
};

/// A pass with its options, type-erased.
class PassInstance {
 public:
  virtual ~PassInstance() = default;
  virtual bool is_mesh_pass() const = 0;
  virtual Outcome run(Scene&, PassContext&) const = 0;  // of a scene pass
  virtual Outcome run(MeshJob&) const = 0;              // of a mesh pass
  /// False when there is no such option or the text is no value for it; `why` says which.
  virtual bool set(std::string_view option, std::string_view value, std::string& why) = 0;
  virtual std::vector<OptionInfo> options() const = 0;
  /// What the outcome depends on beside the scene and the files that it refers to: the pass itself, when it was read
  /// from a file, and files that its options name.
  virtual std::vector<std::string> files() const { return {}; }
};

struct PassInfo {
  std::string_view name, summary;
  Level needs, leaves;
  std::unique_ptr<PassInstance> (*make_of)(const PassInfo&);
  std::string_view doc = {};  // of a pass that was added: all that it says of itself

  /// With its default options.
  std::unique_ptr<PassInstance> make() const { return make_of(*this); }
};

/// Every pass, in the order of the documentation (registry.cpp).
std::span<const PassInfo> passes();
/// Of the list, or one that was added; null when there is none. It lives as long as the program. Any thread.
const PassInfo* find_pass(std::string_view name);
/// Adds a pass that is not in the list, in place of one that was added by that name before. Pipelines that have the one
/// before keep it. False when the list, or a named pipeline, has the name. Any thread.
bool add_pass(std::shared_ptr<const PassInfo> info);
/// The same of what pass<f, Options>(...) gives (passes/pipeline/pass_info.h). Its texts are not copied: they must be
/// literals, or live as long as the program.
bool add_pass(const PassInfo& info);
/// Those that were added, by name.
std::vector<const PassInfo*> added_passes();
/// The name that somebody may have meant, as a question: "; did you mean 'weld'?"; or nothing.
std::string pass_question(std::string_view name);
/// Named pipelines: "gltf" is what convert uses for glTF.
struct NamedPipeline {
  std::string_view name, text, summary;
};
std::span<const NamedPipeline> named_pipelines();

struct PassTime {
  std::string name;
  double seconds;
};

struct PipelineOptions {
  bool verify_each = false;
  std::string print_after;  // a pass, or "all"
  std::function<void(const std::string& pass, const Scene&)> print;
  std::vector<PassTime>* times = nullptr;

  /// Whether passes have to run one by one over the whole scene.
  bool watched() const { return verify_each || !print_after.empty() || times; }
};

class Pipeline {
 public:
  /// Null when the text is no pipeline; `why` says what is wrong with it.
  static std::optional<Pipeline> parse(std::string_view text, std::string& why);
  /// Adds a pass at the end, with these options. False, and why, when there is none, or an option is wrong.
  bool add(std::string_view name, const std::vector<std::pair<std::string, std::string>>& options, std::string& why);
  /// Adds the passes of a named pipeline that this one lacks, by name: those before `tessellate` in front, the others
  /// at the end. So a writer has what it needs whatever was chosen: `weld` for glTF is
  /// `inline,...,weld,tessellate,...`. `combine-lightmap` comes behind the last pass over the scene, which may be the
  /// one that makes the light; what the named one has over the scene behind it stays behind it.
  void complete(std::string_view named);
  /// The whole text, every option spelled out; parse(text()) is this pipeline again.
  std::string text() const;

  /// Runs every pass. False when one failed.
  bool run(Scene&, PassContext&, const PipelineOptions& = {});
  /// Runs every pass but the last group of mesh passes, which the returned source runs for each mesh that it is asked
  /// for. The scene, the context and this pipeline must outlive it. Null when a pass failed.
  MeshSource run_lazily(Scene&, PassContext&, const PipelineOptions& = {});

  /// PassInstance::files of all passes.
  std::vector<std::string> files() const;

  bool empty() const { return steps_.empty(); }
  struct StepInfo {
    std::string_view name;
    std::vector<OptionInfo> options;
  };
  /// What text() says, pass by pass.
  std::vector<StepInfo> steps() const;

 private:
  struct Step {
    const PassInfo* info;
    std::unique_ptr<PassInstance> pass;
  };
  /// `breaches` is told what --verify-each finds.
  bool run_steps(std::size_t begin, std::size_t end, Scene&, PassContext&, const PipelineOptions&,
                 Diagnostics& breaches);
  bool run_mesh_steps(std::size_t begin, std::size_t end, Scene&, PassContext&);
  Level level_behind(std::size_t step) const;
  std::vector<Step> steps_;
};

}  // namespace wrlkit
