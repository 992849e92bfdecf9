#include "tools/cli/session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "base/io/output.h"
#include "base/text/json.h"
#include "passes/lower_vrml1/lower_vrml1.h"
#include "tools/cli/print_diagnostics.h"
#include "convert/embedded_pictures.h"
#include "writers/vrml/vrml.h"

namespace wrlkit {
namespace {

/// Options of the pass `place`.
std::vector<std::pair<std::string, std::string>> placing(std::string_view unit, std::string_view up) {
  std::vector<std::pair<std::string, std::string>> out;
  if (!unit.empty() && unit != "m") out.emplace_back("unit", unit);
  if (!up.empty() && up != "y") out.emplace_back("up", up);
  return out;
}

}  // namespace

/// A file that another one refers to, in the nodes of VRML97.
std::shared_ptr<const Scene> Session::parse_inlined(const std::string& path, Diagnostics& diag) {
  auto world = read_world(path, {.lookups = &buffers_}, diag);
  Statistics uncounted;
  PassContext ctx{diag, uncounted};
  if (world) lower_vrml1(world->scene, {}, ctx);
  return world ? std::make_shared<const Scene>(std::move(world->scene)) : nullptr;
}

std::vector<FileLookup> Session::lookups() const {
  auto all = resources_ ? resources_->lookups() : std::vector<FileLookup>();
  all.insert(all.end(), buffers_.begin(), buffers_.end());
  return all;
}

Session::Session(const Flags& flags)
    : flags_(flags), threads_(flags.jobs), context_{diag_, stats_}, progress_(!flags.quiet) {
  context_.monitor = &progress_;
  good_ = apply_warning_flags();
}

Session::Session(const Flags& flags, std::unique_ptr<World> world, Resources& resources, Diagnostics& diag)
    : flags_(flags),
      threads_(flags.jobs),
      diag_(diag),
      world_(std::move(world)),
      context_{diag_, stats_, &resources},
      progress_(!flags.quiet) {}

bool Session::apply_warning_flags() {
  if (flags_.strict) diag_.warnings_are_errors();
  for (const auto& w : flags_.warnings) {
    if (w == "error") {
      diag_.warnings_are_errors();
      continue;
    }
    bool error = w.starts_with("error="), off = w.starts_with("no-");
    Diag id{};
    if ((!error && !off) || !find_diag(w.substr(error ? 6 : 3), id)) {
      fmt::print(stderr, "wrlkit: there is no message '{}' for -W{}\n", w.substr(w.find_first_of("=-") + 1), w);
      return false;
    }
    diag_.set_severity(id, error ? Severity::error : Severity::ignored);
  }
  return true;
}

World* Session::read(const std::string& path) {
  progress_.begin("reading " + path, 0, "");
  world_.reset();
  auto file = read_file(path, {}, diag_);
  return file ? read(path, *file) : nullptr;
}

World* Session::read(const std::string& path, const FileText& file) {
  world_.reset();
  resources_ = std::make_unique<FileResources>(
      ResourceOptions{.input = path, .allowed = flags_.allow_paths},
      [this](const std::string& inlined, Diagnostics& diag) { return parse_inlined(inlined, diag); });
  context_.resources = resources_.get();
  world_ = parse_world(file, {.allowed = flags_.allow_paths, .lookups = &buffers_}, diag_);
  if (world_) {
    place(world_->scene);
    if (world_->format == Format::gltf && !flags_.output.empty() && flags_.output != "-")
      unpack_pictures(world_->scene, *resources_);
    resources_->set_root({std::shared_ptr<const Scene>{}, &world_->scene});
  }
  return world_.get();
}

/// A pipeline has it; verbs without one see the world as it is placed all the same.
void Session::place(Scene& scene) const {
  if (!pipeline_) place_world(scene, flags_.unit, flags_.up);
}

bool Session::choose_pipeline(std::string_view standard) {
  std::string why;
  pipeline_ = Pipeline::parse(flags_.pipeline_given ? std::string_view(flags_.pipeline) : standard, why);
  if (!pipeline_) {
    fmt::print(stderr, "wrlkit: -p: {}\n", why);
    return false;
  }
  if (flags_.pipeline_given) pipeline_->complete(standard);
  if (!world_ && !pipeline_->put_first("place", placing(flags_.unit, flags_.up), why)) {
    fmt::print(stderr, "wrlkit: --unit, --up: {}\n", why);
    return false;
  }
  const auto& after = flags_.print_after;
  if (!after.empty() && after != "all" && !find_pass(after)) {
    fmt::print(stderr, "wrlkit: --print-after: there is no pass '{}'{}\n", after, pass_question(after));
    return false;
  }
  return true;
}

PipelineOptions Session::pipeline_options() {
  PipelineOptions o;
  o.verify_each = flags_.verify_each;
  o.print_after = flags_.print_after;
  if (!o.print_after.empty())
    o.print = [this](const std::string& pass, const Scene& scene) {
      progress_.clear();
      fmt::print(stderr, "# after {}\n", pass);
      write_vrml(
          scene, {.own_fields = true}, [](std::string_view s) { std::fwrite(s.data(), 1, s.size(), stderr); }, diag_);
    };
  if (flags_.time_passes) o.times = &times_;
  return o;
}

int Session::end(bool made) {
  progress_.clear();
  const int code = exit_code(made);
  if (flags_.time_passes)
    for (auto& t : times_) fmt::print(stderr, "{:>9.3f} s  {}\n", t.seconds, t.name);
  if (flags_.stats)
    for (auto& [name, n] : stats_) fmt::print(stderr, "{:>12}  {}\n", n, name);
  std::fputs(messages_text(diag_, isatty(STDERR_FILENO) != 0, flags_.quiet).c_str(), stderr);
  if (!flags_.report.empty() && !write_report(code)) return usage;
  return code;
}

bool Session::write_report(int code) {
  std::string out;
  JsonOut json(out);
  json.begin_object();
  json.member("inputs", std::span<const std::string>(flags_.inputs));
  json.member("output", flags_.output);
  json.member("exit_code", code);
  for (auto& [name, fact] : facts_) {
    json.key(name);
    json.raw(fact);
  }
  json.key("statistics");
  json.begin_object();
  for (auto& [name, n] : stats_) json.member(name, n);
  json.end_object();
  json.key("messages");
  json.raw(messages_json(diag_));
  json.end_object();
  out += '\n';
  return write_text_file(flags_.report, out);
}

bool write_text_file(const std::string& path, std::string_view text) {
  Diagnostics trouble;
  auto file = OutputFile::open(path, {}, trouble);
  if (file) file->write(text);
  if (file && file->commit(trouble)) return true;
  std::fputs(messages_text(trouble, false, false).c_str(), stderr);
  return false;
}

void place_world(Scene& scene, std::string_view unit, std::string_view up) {
  Pipeline placed;
  std::string why;
  if (!placed.put_first("place", placing(unit, up), why) || placed.empty()) return;
  Diagnostics unheard;
  Statistics uncounted;
  PassContext ctx{unheard, uncounted};
  placed.run(scene, ctx);
}

}  // namespace wrlkit
