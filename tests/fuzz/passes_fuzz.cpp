// What must hold of any pipeline over any world: every pass leaves what its level promises, printing what was read back
// from what was printed gives the same text, and the .glb is loaded by us and by tinygltf without a word. The first
// line is the pipeline, what follows the world; without that line it is the pipeline of glTF alone.
//
// Limits keep a run short: of nodes that come in, of triangles, of seconds; what takes longer is stopped as by a user.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include "tests/fuzz/harness.h"
#include "tests/fuzz/world_mutator.h"
#include "writers/gltf/gltf.h"
#ifdef WRLKIT_TINYGLTF
#include "tests/tinygltf_verdict.h"
#endif

using namespace wrlkit;

namespace {

constexpr auto front = "lower-vrml1{limit=2000},expand{limit=2000},lower-x3d";
constexpr std::chrono::seconds longest{4};
// Light takes seconds a world; the others only read or write files.
constexpr std::string_view left_out[] = {"lightmap"};

/// Stops what runs while it lives for too long.
class Watch {
 public:
  Watch()
      : thread_([this](std::stop_token ended) {
          std::unique_lock lock(mutex_);
          if (!waits_.wait_for(lock, ended, longest, [] { return false; }) && !ended.stop_requested())
            source_.request_stop();
        }) {}
  std::stop_token token() const { return source_.get_token(); }
  bool is_over() const { return source_.stop_requested(); }

 private:
  std::stop_source source_;
  std::mutex mutex_;
  std::condition_variable_any waits_;
  std::jthread thread_;
};

struct Trial {
  Diagnostics diag;
  Statistics stats;
  Watch watch;
  PassContext ctx{diag, stats, nullptr, nullptr, watch.token()};
};

/// Passes may fail, as with nothing to shine on, but never leave what they must not. Those that take manifolds only say
/// so by the same message.
void require_levels(const Diagnostics& diag, const std::string& pipeline) {
  for (const auto& m : diag.messages())
    require(m.id != Diag::verify || m.text().find("is not a manifold") != std::string::npos,
            pipeline + ": " + m.text());
}

void print_twice(const Scene& scene) {
  const bool x3d = scene.dialect() == Dialect::x3d;
  const auto print = [&](const Scene& s) { return x3d ? x3d_text(s) : vrml_text(s); };
  Diagnostics diag;
  // Names may change when they are written the first time, and prototypes move to the front.
  const auto once = parse_world(print(scene), "once", {}, diag);
  require(once != nullptr, "what was printed is not read");
  const auto text = print(once->scene);
  const auto twice = parse_world(text, "twice", {}, diag);
  require(twice != nullptr, "what was printed is not read\n" + text);
  const auto again = print(twice->scene);
  require(again == text, "printed twice, not the same\n" + text + "\nthen\n" + again);
}

void write_and_judge(Scene scene, const std::string& passes) {
  std::string why, bytes;
  auto pipeline = *Pipeline::parse(passes, why);
  pipeline.complete("gltf");
  Trial trial;
  const auto meshes = pipeline.run_lazily(scene, trial.ctx);
  if (!meshes) return;
  const bool good = write_glb(
      scene, meshes, {.max_nodes = 5000}, nullptr, [&](std::string_view b) { bytes += b; }, trial.diag);
  if (!good || trial.watch.is_over()) return;
  Diagnostics diag;
  require(parse_world(bytes, "glb", {}, diag) != nullptr, "our own .glb is not read: " + passes);
#ifdef WRLKIT_TINYGLTF
  const auto said = tinygltf_verdict(bytes);
  require(said.empty(), "tinygltf: " + said + ": " + passes);
#endif
}

/// A pass with options that differ from the default, but for texts, which name files and nodes.
std::string random_pass(std::mt19937& random) {
  const auto& info = passes()[random() % passes().size()];
  const auto pass = info.make();
  static constexpr const char* numbers[] = {"0", "1", "2", "0.5", "10", "0.001", "100", "-1", "0.1", "50"};
  std::string options, why;
  for (const auto& o : pass->options()) {
    if (random() % 3 || o.type == "text") continue;
    std::string value = numbers[random() % std::size(numbers)];
    if (o.type == "bool") value = o.value == "true" ? "false" : "true";
    if (o.type.find('|') != o.type.npos) {
      std::size_t at = 0;
      for (auto n = random() % 5; n > 0 && o.type.find('|', at) != o.type.npos; --n) at = o.type.find('|', at) + 1;
      value = o.type.substr(at, o.type.find('|', at) - at);
    }
    if (pass->set(o.name, value, why)) options += (options.empty() ? "" : ",") + o.name + "=" + quoted_value(value);
  }
  return std::string(info.name) + (options.empty() ? "" : "{" + options + "}");
}

bool has_pipeline(std::string_view text) { return !text.empty() && text[0] != '#' && text[0] != '<'; }

[[maybe_unused]] std::string mutated(std::string text, std::mt19937& random) {
  const auto end = has_pipeline(text) ? std::min(text.find('\n'), text.size()) : 0;
  std::string pipeline = text.substr(0, end), world = text.substr(std::min(text.size(), end + (end > 0)));
  if (random() % 2)
    return pipeline + (pipeline.empty() ? "" : "\n") + mutated_world(std::move(world), Format::vrml97, random);
  if (random() % 4 == 0) pipeline.clear();
  return pipeline + (pipeline.empty() ? "" : ",") + random_pass(random) + "\n" + world;
}

}  // namespace

#ifdef WRLKIT_LIBFUZZER
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  return mutate_in_turn(data, size, most, seed, mutated);
}
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto bytes = text_of(data, size);
  std::string passes(front), why;
  if (has_pipeline(bytes)) {
    const auto end = std::min(bytes.find('\n'), bytes.size());
    passes += "," + std::string(bytes.substr(0, end));
    bytes.remove_prefix(std::min(bytes.size(), end + 1));
  }
  auto pipeline = Pipeline::parse(passes, why);
  if (!pipeline) return 0;
  for (const auto& step : pipeline->steps())
    if (std::ranges::find(left_out, step.name) != std::end(left_out)) return 0;
  const auto world = world_of(bytes);
  if (!world || world->format == Format::gltf) return 0;
  print_twice(world->scene);
  write_and_judge(world->scene, passes);
  Trial trial;
  pipeline->run(world->scene, trial.ctx, {.verify_each = true});
  require_levels(trial.diag, passes);
  return 0;
}
