#include "passes/pipeline/pipeline.h"

#include <algorithm>
#include <chrono>
#include <unordered_map>
#include <utility>

#include "base/stop.h"
#include "geometry/geometry.h"
#include "geometry/mesh_check.h"
#include "scenegraph/driven.h"
#include "scenegraph/nodes.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// What is gathered is as its files have it. Faces of what is still to be expanded make no scene of meshes.
Level level_after(Level level, const PassInfo& info) {
  if (info.traits.phase == Phase::gather) return info.leaves;
  const bool next = static_cast<int>(info.leaves) == static_cast<int>(level) + 1;
  return next ? info.leaves : level;
}

class Timer {
 public:
  Timer(std::vector<PassTime>* to, std::string name)
      : to_(to), name_(std::move(name)), start_(std::chrono::steady_clock::now()) {}
  ~Timer() {
    if (to_) to_->push_back({name_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count()});
  }

 private:
  std::vector<PassTime>* to_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace

/// By itself, or by parts.
bool Pipeline::has_in_effect(const PassInfo& info) const {
  auto has = [&](std::string_view name) {
    return std::ranges::any_of(steps_, [&](const Step& s) { return s.info->name == name; });
  };
  if (has(info.name)) return true;
  for (auto rest = info.traits.parts; !rest.empty();) {
    const auto comma = std::min(rest.find(','), rest.size());
    if (!has(rest.substr(0, comma))) return false;
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return !info.traits.parts.empty();
}

/// Moves passes of phase `gathered` behind the last one that gathers, or, without such, in front of the first that
/// lowers or does more.
void Pipeline::move_gathered() {
  const auto phase = [](const Step& s) { return s.info->traits.phase; };
  const auto stays = [&](const Step& s) { return phase(s) != Phase::gathered; };
  const auto first = std::stable_partition(steps_.begin(), steps_.end(), stays);
  std::vector<Step> moved(std::make_move_iterator(first), std::make_move_iterator(steps_.end()));
  steps_.erase(first, steps_.end());
  const auto last = std::ranges::find(steps_.rbegin(), steps_.rend(), Phase::gather, phase);
  const auto beyond = [&](const Step& s) { return phase(s) > Phase::gathered; };
  const auto at = last != steps_.rend() ? last.base() : std::ranges::find_if(steps_, beyond);
  steps_.insert(at, std::make_move_iterator(moved.begin()), std::make_move_iterator(moved.end()));
}

void Pipeline::add_gathered(std::string_view name) {
  const auto* const info = find_pass(name);
  if (has_in_effect(*info)) return;
  steps_.push_back({info, info->make()});
  move_gathered();
  meet_needs();
}

void Pipeline::complete(std::string_view text) {
  std::string why;
  auto standard = parse(text, why);
  move_gathered();
  auto first_of = [&](Phase phase) {
    return std::ranges::find_if(standard->steps_, [&](const Step& s) { return s.info->traits.phase >= phase; });
  };
  const auto light = first_of(Phase::light), mesh = first_of(Phase::mesh), end = standard->steps_.end();
  Level reached = Level::authored;
  std::vector<bool> lacking;
  for (const Step& s : standard->steps_) lacking.push_back(!has_in_effect(*s.info));
  for (auto s = standard->steps_.begin(); s != light; ++s)
    if (lacking[static_cast<std::size_t>(s - standard->steps_.begin())]) reached = std::max(reached, s->info->leaves);
  meet_needs(reached);
  auto missing = [&](auto from, auto to) {
    std::vector<Step> out;
    for (; from != to; ++from)
      if (lacking[static_cast<std::size_t>(from - standard->steps_.begin())]) out.push_back(std::move(*from));
    return out;
  };
  auto insert = [&](auto where, std::vector<Step>&& all) {
    steps_.insert(where, std::make_move_iterator(all.begin()), std::make_move_iterator(all.end()));
  };
  auto front = missing(standard->steps_.begin(), light);
  const auto last_over_scene =
      std::ranges::find_if(steps_.rbegin(), steps_.rend(), [](const Step& s) { return !s.pass->is_mesh_pass(); });
  insert(last_over_scene.base(), missing(light, mesh));
  // Where nothing is drawn, what the standard pipeline does to a scene is done to what other passes bring in as well.
  auto brings_in = [](const Step& s) { return s.info->traits.brings_in; };
  if (mesh == end && std::ranges::any_of(steps_, brings_in)) {
    const auto rest = std::stable_partition(front.begin(), front.end(),
                                            [](const Step& s) { return s.info->traits.phase == Phase::start; });
    std::vector<Step> behind(std::make_move_iterator(rest), std::make_move_iterator(front.end()));
    front.erase(rest, front.end());
    insert(std::ranges::find_if(steps_.rbegin(), steps_.rend(), brings_in).base(), std::move(behind));
  }
  insert(steps_.begin(), std::move(front));
  insert(steps_.end(), missing(mesh, end));
  move_gathered();
}

void Pipeline::meet_needs(Level level) {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (level < steps_[i].info->needs) {  // one level at a time, as level_after counts them
      const auto next = static_cast<Level>(static_cast<int>(level) + 1);
      const auto reaches = std::ranges::find(passes(), next, &PassInfo::leaves);
      steps_.insert(steps_.begin() + static_cast<std::ptrdiff_t>(i), Step{&*reaches, reaches->make()});
    }
    level = level_after(level, *steps_[i].info);
  }
}

bool Pipeline::run(Scene& scene, PassContext& ctx, const PipelineOptions& options) {
  meet_needs();
  return run_until_stopped(steps_.size(), scene, ctx, options);
}

bool Pipeline::run_until_stopped(std::size_t end, Scene& scene, PassContext& ctx, const PipelineOptions& options) {
  // Passes go down without asking where they are: what a program has made may have no end.
  if (!verify(scene, Level::authored, ctx.diag)) return false;
  const StopScope scope(ctx.stop);
  try {
    return run_steps(0, end, scene, ctx, options);
  } catch (const Stopped&) {
    return false;
  }
}

Level Pipeline::level_behind(std::size_t step) const {
  Level level = Level::authored;
  for (std::size_t i = 0; i <= step; ++i) level = level_after(level, *steps_[i].info);
  return level;
}

bool Pipeline::run_steps(std::size_t begin, std::size_t end, Scene& scene, PassContext& ctx,
                         const PipelineOptions& options) {
  for (std::size_t i = begin; i < end;) {
    if (ctx.stop.stop_requested()) return false;
    std::size_t next = i + 1;
    // Mesh passes run together unless a watcher looks between them.
    if (steps_[i].pass->is_mesh_pass() && !options.watched())
      while (next < end && steps_[next].pass->is_mesh_pass()) ++next;
    {
      Timer timer(options.times, std::string(steps_[i].info->name));
      if (ctx.monitor) ctx.monitor->begin(std::string(steps_[i].info->name), 0, "");
      const auto n_said = ctx.diag.count();
      bool good = steps_[i].pass->is_mesh_pass() ? run_mesh_steps(i, next, scene, ctx)
                                                 : steps_[i].pass->run(scene, ctx) != Outcome::failed;
      if (!good) return failed(i, n_said, ctx);
    }
    const auto& done = *steps_[next - 1].info;
    if (options.verify_each && !verify(scene, level_behind(next - 1), ctx.diag)) return false;
    if (options.print && (options.print_after == done.name || options.print_after == "all"))
      options.print(std::string(done.name), scene);
    i = next;
  }
  return true;
}

/// Never without a word.
bool Pipeline::failed(std::size_t step, std::size_t n_said_before, PassContext& ctx) const {
  const bool is_stopped = ctx.stop.stop_requested();
  if (!is_stopped && ctx.diag.count() == n_said_before) ctx.diag.report(Diag::pass_failed, {}, steps_[step].info->name);
  return false;
}

bool Pipeline::run_mesh_steps(std::size_t begin, std::size_t end, Scene& scene, PassContext& ctx) {
  Mesh mesh;
  MeshScratch scratch;
  const auto n_said = ctx.diag.count();
  const auto textured = textured_geometry(scene);
  const auto driven = driven_geometry(scene);
  for (NodeId n : all_nodes(scene)) {
    if (!is_geometry(scene, n) || driven[n.value]) continue;
    if (ctx.stop.stop_requested()) return false;
    MeshJob job{scene, n, mesh, scratch, ctx, textured[n.value] != 0};
    read_mesh(job);
    bool changed = false;
    for (std::size_t i = begin; i < end; ++i) {
      auto outcome = steps_[i].pass->run(job);
      if (outcome == Outcome::failed) return failed(i, n_said, ctx);
      changed |= outcome == Outcome::changed;
    }
    if (changed) store_mesh(scene, n, mesh);
  }
  return true;
}

/// What mesh passes need to know of the whole scene.
struct Pipeline::LazyState {
  const Scene& scene;
  std::size_t tail;  // the first of these passes
  bool verify;
  std::vector<PassTime>* times;
  std::size_t first_time;  // of these passes in `times`
  std::vector<char> textured, driven;
};

void Pipeline::run_tail(MeshJob& job, const LazyState& state) const {
  read_mesh(job);
  for (std::size_t i = state.tail; i < steps_.size(); ++i) {
    job.mesh.cut.clear();
    const auto start = state.times ? std::chrono::steady_clock::now() : std::chrono::steady_clock::time_point();
    const auto n_said = job.ctx.diag.count();
    if (steps_[i].pass->run(job) == Outcome::failed && job.ctx.diag.count() == n_said)
      job.ctx.diag.report(Diag::pass_failed, state.scene.where(job.geometry), steps_[i].info->name);
    if (state.times)
      (*state.times)[state.first_time + i - state.tail].seconds +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!state.verify) continue;
    if (const auto breach = breach_of(job.mesh); !breach.empty())
      job.ctx.diag.report(Diag::verify, state.scene.where(job.geometry),
                          std::string(steps_[i].info->name) + ": " + breach);
  }
}

MeshMaker Pipeline::mesh_maker(std::shared_ptr<const LazyState> state, Task& task) const {
  return [this, state = std::move(state), scratch = std::make_shared<MeshScratch>(), &task](NodeId n, Mesh& out) {
    const bool known = n.value < state->textured.size();
    MeshJob job{state->scene,
                n,
                out,
                *scratch,
                task,
                known && state->textured[n.value] != 0,
                known && state->driven[n.value] != 0};
    run_tail(job, *state);
  };
}

MeshSource Pipeline::run_lazily(Scene& scene, PassContext& ctx, const PipelineOptions& options, MeshMakers* makers) {
  meet_needs();
  std::size_t tail = steps_.size();
  while (tail > 0 && steps_[tail - 1].pass->is_mesh_pass()) --tail;
  if (!run_until_stopped(tail, scene, ctx, options)) return nullptr;
  // The scene between the last passes is never there as a whole; a watcher is shown a copy.
  if (options.print) {
    Scene copy = scene;
    Diagnostics quiet(ctx.diag.shared_sources());
    Statistics uncounted;
    PassContext watching{quiet, uncounted, ctx.resources};
    if (!run_steps(tail, steps_.size(), copy, watching, {.print_after = options.print_after, .print = options.print}))
      return nullptr;
  }
  const auto first_time = options.times ? options.times->size() : 0;
  if (options.times)
    for (std::size_t i = tail; i < steps_.size(); ++i) options.times->push_back({std::string(steps_[i].info->name), 0});
  const auto state = std::make_shared<const LazyState>(LazyState{.scene = scene,
                                                                 .tail = tail,
                                                                 .verify = options.verify_each,
                                                                 .times = options.times,
                                                                 .first_time = first_time,
                                                                 .textured = textured_geometry(scene),
                                                                 .driven = driven_geometry(scene)});
  if (makers && !options.watched()) *makers = [this, state](Task& task) { return mesh_maker(state, task); };
  return [make = mesh_maker(state, ctx), mesh = std::make_shared<Mesh>()](NodeId n) -> const Mesh& {
    make(n, *mesh);
    return *mesh;
  };
}

}  // namespace wrlkit
