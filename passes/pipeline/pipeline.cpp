#include "passes/pipeline/pipeline.h"

#include <algorithm>
#include <chrono>
#include <unordered_map>
#include <utility>

#include "base/text/blanks.h"
#include "geometry/geometry.h"
#include "passes/analysis/driven.h"
#include "scenegraph/nodes.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// Up to the first of `stops` outside of braces, and what follows it.
std::string_view cut(std::string_view& rest, char stop) {
  int depth = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '{') ++depth;
    if (rest[i] == '}') --depth;
    if (rest[i] == stop && depth == 0) {
      auto head = rest.substr(0, i);
      rest.remove_prefix(i + 1);
      return trim(head);
    }
  }
  return trim(std::exchange(rest, {}));
}

bool set_options(PassInstance& pass, std::string_view list, std::string& why) {
  while (!trim(list).empty()) {
    auto option = cut(list, ',');
    auto equals = option.find('=');
    auto name = trim(option.substr(0, equals));
    auto value = equals == option.npos ? std::string_view("true") : trim(option.substr(equals + 1));
    if (!pass.set(name, value, why)) return false;
  }
  return true;
}

std::string no_such_pass(std::string_view name) {
  return "there is no pass '" + std::string(name) + "'" + pass_question(name);
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

std::optional<Pipeline> Pipeline::parse(std::string_view text, std::string& why) {
  for (auto& n : named_pipelines())
    if (n.name == trim(text)) text = n.text;
  Pipeline p;
  while (!trim(text).empty()) {
    auto item = cut(text, ',');
    auto brace = item.find('{');
    auto name = trim(item.substr(0, brace));
    auto* info = find_pass(name);
    if (!info) {
      why = no_such_pass(name);
      return std::nullopt;
    }
    Step s{info, info->make()};
    if (brace != item.npos) {
      if (item.back() != '}') {
        why = "'}' is missing behind '" + std::string(name) + "'";
        return std::nullopt;
      }
      if (!set_options(*s.pass, item.substr(brace + 1, item.size() - brace - 2), why)) {
        why = "pass '" + std::string(name) + "' " + why;
        return std::nullopt;
      }
    }
    p.steps_.push_back(std::move(s));
  }
  return p;
}

bool Pipeline::add(std::string_view name, const std::vector<std::pair<std::string, std::string>>& options,
                   std::string& why) {
  auto* info = find_pass(name);
  if (!info) {
    why = no_such_pass(name);
    return false;
  }
  Step s{info, info->make()};
  for (const auto& [option, value] : options)
    if (!s.pass->set(option, value, why)) {
      why = "pass '" + std::string(name) + "' " + why;
      return false;
    }
  steps_.push_back(std::move(s));
  return true;
}

void Pipeline::complete(std::string_view named) {
  std::string why;
  auto standard = parse(named, why);
  auto at = [&](std::string_view name) {
    return std::ranges::find(standard->steps_, name, [](const Step& s) { return s.info->name; });
  };
  const auto split = at("tessellate"), combine = std::min(at("combine-lightmap"), split);
  std::vector<const PassInfo*> chosen;
  for (const Step& s : steps_) chosen.push_back(s.info);
  auto missing = [&](auto from, auto to) {
    std::vector<Step> out;
    for (; from != to; ++from)
      if (std::ranges::find(chosen, from->info) == chosen.end()) out.push_back(std::move(*from));
    return out;
  };
  auto insert = [&](auto where, std::vector<Step>&& all) {
    steps_.insert(where, std::make_move_iterator(all.begin()), std::make_move_iterator(all.end()));
  };
  auto front = missing(standard->steps_.begin(), combine);
  auto last_over_scene =
      std::ranges::find_if(steps_.rbegin(), steps_.rend(), [](const Step& s) { return !s.pass->is_mesh_pass(); });
  insert(last_over_scene.base(), missing(combine, split));
  // Where nothing is drawn, what the standard pipeline does to a world is done to those that Inlines bring in as well,
  // and to the metadata that `merge` makes.
  auto brings_in = [](const Step& s) {
    return s.info->name == "inline" || s.info->name == "expand-protos" || s.info->name == "merge";
  };
  if (split == standard->steps_.end() && std::ranges::any_of(steps_, brings_in)) {
    if (!front.empty() && front[0].info->name == "lower-vrml1") {
      steps_.insert(steps_.begin(), std::move(front[0]));
      front.erase(front.begin());
    }  // Inlines are found behind it
    return insert(std::ranges::find_if(steps_.rbegin(), steps_.rend(), brings_in).base(), std::move(front));
  }
  insert(steps_.begin(), std::move(front));
  insert(steps_.end(), missing(split, standard->steps_.end()));
}

std::vector<Pipeline::StepInfo> Pipeline::steps() const {
  std::vector<StepInfo> out;
  for (const auto& s : steps_) out.push_back({s.info->name, s.pass->options()});
  return out;
}

std::vector<std::string> Pipeline::files() const {
  std::vector<std::string> out;
  for (const auto& s : steps_)
    for (auto& file : s.pass->files()) out.push_back(std::move(file));
  return out;
}

std::string Pipeline::text() const {
  std::string out;
  for (const auto& [name, options] : steps()) {
    out += (out.empty() ? "" : ",") + std::string(name);
    for (std::size_t i = 0; i < options.size(); ++i) out += (i ? "," : "{") + options[i].name + "=" + options[i].value;
    if (!options.empty()) out += "}";
  }
  return out;
}

bool Pipeline::run(Scene& scene, PassContext& ctx, const PipelineOptions& options) {
  return run_steps(0, steps_.size(), scene, ctx, options, ctx.diag);
}

/// A pass that does not find the level it needs leaves what it finds: normals in front of tessellate make no mesh of a
/// Box.
Level Pipeline::level_behind(std::size_t step) const {
  Level level = Level::authored;
  for (std::size_t i = 0; i <= step; ++i)
    if (level >= steps_[i].info->needs) level = steps_[i].info->leaves;
  return level;
}

bool Pipeline::run_steps(std::size_t begin, std::size_t end, Scene& scene, PassContext& ctx,
                         const PipelineOptions& options, Diagnostics& breaches) {
  for (std::size_t i = begin; i < end;) {
    if (ctx.stop.stop_requested()) return false;
    std::size_t next = i + 1;
    // Mesh passes run together unless somebody wants to look between them.
    if (steps_[i].pass->is_mesh_pass() && !options.watched())
      while (next < end && steps_[next].pass->is_mesh_pass()) ++next;
    {
      Timer timer(options.times, std::string(steps_[i].info->name));
      if (ctx.monitor) ctx.monitor->begin(std::string(steps_[i].info->name), 0, "");
      bool good = steps_[i].pass->is_mesh_pass() ? run_mesh_steps(i, next, scene, ctx)
                                                 : steps_[i].pass->run(scene, ctx) != Outcome::failed;
      if (!good) return false;
    }
    const auto& done = *steps_[next - 1].info;
    if (options.verify_each && !verify(scene, level_behind(next - 1), breaches)) return false;
    if (options.print && (options.print_after == done.name || options.print_after == "all"))
      options.print(std::string(done.name), scene);
    i = next;
  }
  return true;
}

bool Pipeline::run_mesh_steps(std::size_t begin, std::size_t end, Scene& scene, PassContext& ctx) {
  Mesh mesh;
  MeshScratch scratch;
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
      if (outcome == Outcome::failed) return false;
      changed |= outcome == Outcome::changed;
    }
    if (changed) store_mesh(scene, n, mesh);
  }
  return true;
}

MeshSource Pipeline::run_lazily(Scene& scene, PassContext& ctx, const PipelineOptions& options) {
  std::size_t tail = steps_.size();
  while (tail > 0 && steps_[tail - 1].pass->is_mesh_pass()) --tail;
  if (!run_steps(0, tail, scene, ctx, options, ctx.diag)) return nullptr;
  // Who wants to look between the mesh passes sees them on a copy: what is written does not depend on being watched.
  if (options.watched()) {
    Scene copy = scene;
    Diagnostics quiet(ctx.diag.shared_sources());
    Statistics uncounted;
    PassContext watching{quiet, uncounted, ctx.resources};
    if (!run_steps(tail, steps_.size(), copy, watching, options, ctx.diag)) return nullptr;
  }
  struct State {
    Mesh mesh;
    MeshScratch scratch;
    std::vector<char> textured, driven;
  };
  auto state = std::make_shared<State>();
  state->textured = textured_geometry(scene);
  state->driven = driven_geometry(scene);
  return [this, tail, &scene, &ctx, state](NodeId n) -> const Mesh& {
    const bool known = n.value < state->textured.size();
    MeshJob job{scene,
                n,
                state->mesh,
                state->scratch,
                ctx,
                known && state->textured[n.value] != 0,
                known && state->driven[n.value] != 0};
    read_mesh(job);
    for (std::size_t i = tail; i < steps_.size(); ++i) {
      state->mesh.cut.clear();
      steps_[i].pass->run(job);
    }
    return state->mesh;
  };
}

}  // namespace wrlkit
