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
#include "passes/pipeline/written_file.h"

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
  /// False when there is no such option or the text is not a value for it; `why` says which.
  virtual bool set(std::string_view option, std::string_view value, std::string& why) = 0;
  virtual std::vector<OptionInfo> options() const = 0;
  /// What the outcome depends on in addition to the scene and the files that it refers to: the pass itself, when it was
  /// read from a file, and files that its options name.
  virtual std::vector<std::string> files() const { return {}; }
  /// Options that name a file to be written, and those files.
  virtual std::vector<std::pair<std::string_view, WrittenFile>> written_files() const { return {}; }
};

/// Where a pass has its place among others: what a pipeline lacks for its writer goes there.
enum class Phase : std::uint8_t {
  start,     // before anything is looked for in the scene
  gather,    // all of the world in one scene
  gathered,  // once it is, and before nodes are lowered: wherever a pipeline that is completed has it
  lower,     // nodes that others do not know, as those that they know
  world,     // whatever is wanted of the whole scene
  light,     // behind the last pass over the scene, which may be the one that makes the light
  mesh,      // at the end, one geometry after the other
};

/// What else a pipeline has to know of a pass.
struct PassTraits {
  Phase phase = Phase::world;
  bool brings_in = false;       // nodes come in that passes before it have not seen
  bool idempotent = false;      // a second run with the same options changes nothing
  std::string_view parts = {};  // passes that together do what this one does: "inline,expand-protos"
};

struct PassInfo {
  std::string_view name, summary;
  Level needs;   // it is refused, or what is missing is put in front of it, where the pipeline has not reached that
  Level leaves;  // what it makes of the level before; it lowers none
  std::unique_ptr<PassInstance> (*make_of)(const PassInfo&);
  std::string_view doc = {};  // all that it says of itself, with an example
  std::span<const StatisticInfo> statistics = {};
  PassTraits traits = {};

  /// With its default options.
  std::unique_ptr<PassInstance> make() const { return make_of(*this); }
};

/// Every pass, in the order of the documentation (registry.cpp).
std::span<const PassInfo> passes();
/// A pass of the list, or one that was added; null when there is none. It lives as long as the program. Any thread.
const PassInfo* find_pass(std::string_view name);
/// Adds a pass that is not in the list, in place of one that was added by that name before. Pipelines that have the one
/// before keep it. False when the list, or a named pipeline, has the name. Any thread.
bool add_pass(std::shared_ptr<const PassInfo> info);
/// The same of what pass<f, Options>(...) gives (passes/pipeline/pass_info.h). Its texts are not copied: they must be
/// literals, or live as long as the program.
bool add_pass(const PassInfo& info);
/// Those that were added, by name.
std::vector<const PassInfo*> added_passes();
/// The name that may have been meant, as a question: "; did you mean 'weld'?"; or nothing.
std::string pass_question(std::string_view name);
/// Named pipelines: "gltf" is what convert uses for glTF.
struct NamedPipeline {
  std::string_view name, text, summary;
};
std::span<const NamedPipeline> named_pipelines();

/// As the text of a pipeline has the value of an option: in quotes where it must be.
std::string quoted_value(std::string_view);

struct PassTime {
  std::string name;
  double seconds;
};

struct PipelineOptions {
  bool verify_each = false;
  std::string print_after;  // a pass, or "all"
  std::function<void(const std::string& pass, const Scene&)> print;
  /// Seconds of each pass; those of run_lazily grow while meshes are asked for, and must outlive its source.
  std::vector<PassTime>* times = nullptr;

  /// Whether passes have to run one by one over the whole scene.
  bool watched() const { return verify_each || !print_after.empty() || times; }
};

/// Fills a mesh of the caller as a MeshSource does.
using MeshMaker = std::function<void(NodeId geometry, Mesh& out)>;

/// A maker of meshes for one thread at a time, with its own memory; messages and counts go to that Task. All of
/// them may work at the same time, while the scene does not change.
using MeshMakers = std::function<MeshMaker(Task&)>;

class Pipeline {
 public:
  /// Null when the text is not a pipeline; `why` says what is wrong with it.
  /// Names of pipelines are replaced by their passes: "gltf,weld". Values with commas, braces or quotes are put in
  /// quotes, in which a backslash is put before quotes and backslashes: merge{csv="a,b.csv"}.
  static std::optional<Pipeline> parse(std::string_view text, std::string& why);
  /// Adds a pass at the end, with these options. False, and why, when there is none, or an option is wrong.
  bool add(std::string_view name, const std::vector<std::pair<std::string, std::string>>& options, std::string& why);
  /// The same at the begin, where there are options at all and the pass is not in it yet.
  bool put_first(std::string_view name, const std::vector<std::pair<std::string, std::string>>& options,
                 std::string& why);
  /// Sets an option of every pass of that name in it. False, and why, when one has no such option or value.
  bool set(std::string_view name, std::string_view option, std::string_view value, std::string& why);
  /// Adds a pass of phase `gathered`, unless it is in it: behind the passes that gather the world.
  void add_gathered(std::string_view name);
  /// Adds the passes of another pipeline, which a writer needs, as far as this one lacks them, by phase: those before
  /// `light` in front, those of `light` and what stands behind them behind the last pass over the scene, those of
  /// `mesh` at the end. So `weld` for glTF is `expand,...,weld,combine-lightmap,tessellate,...`. Then as meet_needs.
  void complete(std::string_view standard);
  /// Where a pass needs a level that the passes before it do not reach, one that reaches it is put in front of it.
  void meet_needs() { meet_needs(Level::authored); }
  /// The whole text, every option spelled out; parse(text()) is this pipeline again.
  std::string text() const;

  /// Runs every pass, after meet_needs. False, reported, when `verify` does not take the scene, or a pass failed, or
  /// was stopped (PassContext::stop, not reported): the scene is valid then, but as far as it has come.
  bool run(Scene&, PassContext&, const PipelineOptions& = {});
  /// Runs every pass but the last group of mesh passes, which the returned source runs for each mesh that it is asked
  /// for. The scene, the context and this pipeline must outlive it. Null when a pass failed. `makers`, if given, makes
  /// more of these, for other threads; it stays null when the passes are watched.
  MeshSource run_lazily(Scene&, PassContext&, const PipelineOptions& = {}, MeshMakers* makers = nullptr);

  /// PassInstance::files of all passes.
  std::vector<std::string> files() const;
  /// What its passes write to files that their options name.
  std::vector<WrittenFileOption> written_files() const;

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
  bool run_until_stopped(std::size_t end, Scene&, PassContext&, const PipelineOptions&);
  bool run_steps(std::size_t begin, std::size_t end, Scene&, PassContext&, const PipelineOptions&);
  bool failed(std::size_t step, std::size_t n_said_before, PassContext&) const;
  bool run_mesh_steps(std::size_t begin, std::size_t end, Scene&, PassContext&);
  struct LazyState;
  void run_tail(MeshJob&, const LazyState&) const;
  MeshMaker mesh_maker(std::shared_ptr<const LazyState>, Task&) const;
  bool append(std::string_view text, std::string& why);
  void meet_needs(Level before);
  void move_gathered();
  bool has_in_effect(const PassInfo&) const;
  Level level_behind(std::size_t step) const;
  std::vector<Step> steps_;
};

}  // namespace wrlkit
