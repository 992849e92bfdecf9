#include "tools/cli/session.h"
#include "tools/cli/documents.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "base/io/output.h"
#include "base/text/json.h"
#include "base/text/nearest_name.h"
#include "convert/nothing_shown.h"
#include "convert/placing.h"
#include "passes/switch/switch.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "tools/cli/outputs.h"
#include "tools/cli/print_diagnostics.h"
#include "writers/named_files.h"
#include "writers/vrml/vrml.h"

namespace wrlkit {
Session::Session(const Flags& flags)
    : flags_(flags), threads_(flags.jobs), progress_(!flags.quiet), document_(load_options(), {&progress_}) {}

/// What the flags say; not good when they name a message that there is not, which is printed.
LoadOptions Session::load_options() {
  LoadOptions out = flags_.load;
  out.project_files = !flags_.strict_paths && !flags_.serve;  // not for users who are not asked
  out.map_files = true;                                       // run_program says what it is when one is cut
  out.unpack_pictures = !flags_.output.empty() && flags_.output != "-";
  for (const auto& w : flags_.warnings) {
    if (apply_warning_flag(out, w)) continue;
    const auto name = w.substr(w.find_first_of("=-") + 1);
    NearestName nearest(name);
    for (const auto& d : all_diags()) nearest.consider(d.name);
    fmt::print(stderr, "wrlkit: there is no message '{}' for -W{}{}\n", name, w, nearest.question());
    good_ = false;
    break;
  }
  return out;
}

bool apply_warning_flag(LoadOptions& options, const std::string& flag) {
  if (flag == "error") {
    options.strict = true;
    return true;
  }
  if (flag == "error=lost") {
    for (const auto& d : all_diags())
      if (d.severity == Severity::lost) options.severities.emplace_back(d.id, Severity::error);
    return true;
  }
  const bool error = flag.starts_with("error=");
  Diag id{};
  if ((!error && !flag.starts_with("no-")) || !find_diag(flag.substr(error ? 6 : 3), id)) return false;
  options.severities.emplace_back(id, error ? Severity::error : Severity::ignored);
  return true;
}

bool Session::choose_pipeline(std::string_view standard) {
  std::string why;
  pipeline_ = Pipeline::parse(flags_.pipeline_given ? std::string_view(flags_.pipeline) : standard, why);
  if (!pipeline_) {
    fmt::print(stderr, "wrlkit: -p: {}\n", why);
    return false;
  }
  if (flags_.pipeline_given) pipeline_->complete(standard);
  pipeline_->put_first("place", place_options(flags_.load.unit, flags_.load.up), why);
  if (flags_.load.show_all) pipeline_->add_gathered("switch");
  if (flags_.load.show_all) pipeline_->set("switch", "all", "true", why);
  if (flags_.load.run_startup) pipeline_->add_gathered("startup");
  document_.leave_unplaced();
  const auto& after = flags_.print_after;
  if (!after.empty() && after != "all" && !find_pass(after)) {
    fmt::print(stderr, "wrlkit: --print-after: there is no pass '{}'{}\n", after, pass_question(after));
    return false;
  }
  if (!after.empty() && after != "all" && !runs(after) && !flags_.quiet)
    fmt::print(stderr, "wrlkit: --print-after has no effect: the pipeline has no pass '{}'; see --print-pipeline\n",
               after);
  return check_written_files(flags_, pipeline_->written_files());
}

bool Session::runs(std::string_view pass) const {
  if (!pipeline_) return false;
  const auto steps = pipeline_->steps();
  return std::ranges::find(steps, pass, &Pipeline::StepInfo::name) != steps.end();
}

bool Session::chooses_switches() const {
  const Scene& scene = document_.world().scene;
  const bool inlines = any_node(scene, [&](NodeId n) { return scene.is(n, nodes::Inline); });  // which may have them
  const auto fits = [&](const OptionInfo& o) {
    return o.name == "all" ? o.value == "true" : inlines || has_switch_named(scene, o.name);
  };
  const auto steps = pipeline_ ? pipeline_->steps() : std::vector<Pipeline::StepInfo>();
  return std::ranges::any_of(
      steps, [&](const Pipeline::StepInfo& s) { return s.name == "switch" && std::ranges::any_of(s.options, fits); });
}

bool Session::read(const std::string& path) {
  if (!document_.read(path)) return false;
  const bool follows_inlines = !pipeline_ || runs("expand") || runs("inline");
  if (!chooses_switches() && !runs("startup"))
    report_undrawn(world().scene, follows_inlines ? &resources() : nullptr, diag());
  return true;
}

bool Session::printed_pipeline() const {
  if (flags_.print_pipeline) fmt::print("{}\n", pipeline_->text());
  return flags_.print_pipeline;
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
          scene, {.own_fields = true}, [](std::string_view s) { std::fwrite(s.data(), 1, s.size(), stderr); }, diag());
    };
  if (flags_.time_passes) o.times = &times_;
  return o;
}

int Session::end(bool made, int not_made, int at_least) {
  progress_.clear();
  if (made && document_.resources()) write_named_files(resources(), diag());
  document_.report_files_above();
  const int code = made ? std::max(exit_code(made, not_made), at_least) : not_made;
  if (flags_.time_passes)
    for (auto& t : times_) fmt::print(stderr, "{:>9.3f} s  {}\n", t.seconds, t.name);
  if (flags_.stats)
    for (auto& [name, n] : context().stats) fmt::print(stderr, "{:>12}  {}\n", n, name);
  std::fflush(stdout);  // what it is about stands before the messages
  const auto text = brief_ ? messages_brief : messages_text;
  std::fputs(text(diag(), isatty(STDERR_FILENO) != 0, flags_.quiet).c_str(), stderr);
  if (flags_.json && !made && !has_json_) print_json(report_json(code));
  if (!flags_.report.empty() && !write_text_file(flags_.report, report_json(code) + '\n')) return nothing;
  return code;
}

void Session::print_json(std::string_view json) {
  has_json_ = true;
  print_document(json);
}

std::string Session::report_json(int code) {
  std::string out;
  JsonOut json(out);
  json.object([&] {
    json.members("inputs", std::span<const std::string>(flags_.inputs), "output", flags_.output, "exit_code", code);
    for (auto& [name, fact] : facts_) {
      json.member(name, JsonText{fact});
    }
    json.member("statistics", context().stats);
    json.member("messages", JsonText{messages_json(diag())});
  });
  return out;
}

bool write_text_file(const std::string& path, std::string_view text) {
  Diagnostics trouble;
  auto file = OutputFile::open(path, {}, trouble);
  if (file) file->write(text);
  if (file && file->commit(trouble)) return true;
  std::fputs(messages_text(trouble, false, false).c_str(), stderr);
  return false;
}

}  // namespace wrlkit
