// One run of a verb over one world, or one after the other: messages, files it may read, progress, report and exit
// code.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "parsers/parsers.h"
#include "parsers/resources.h"
#include "passes/pipeline/pipeline.h"
#include "tools/cli/flags.h"
#include "tools/cli/progress.h"

namespace wrlkit {

class Session {
 public:
  explicit Session(const Flags&);
  /// Over a world that was read elsewhere, with its files; what there is to say goes to `diag`.
  Session(const Flags&, std::unique_ptr<World>, Resources&, Diagnostics& diag);

  /// False when a flag makes no sense; that was printed.
  bool good() const { return good_; }
  const Flags& flags() const { return flags_; }
  Diagnostics& diag() { return diag_; }
  Resources& resources() { return *context_.resources; }
  PassContext& context() { return context_; }
  Progress& progress() { return progress_; }

  /// Reads a world, in place of the one before, and applies --unit and --up; null when nothing can be had.
  World* read(const std::string& path);
  /// The same of a file that was read already.
  World* read(const std::string& path, const FileText& file);
  /// The files that were asked for beside it, found or not.
  std::vector<FileLookup> lookups() const;
  /// What `read` gave.
  World& world() { return *world_; }
  /// -p with what it lacks of `standard`, or else `standard`; false when it is no pipeline, which was printed.
  bool choose_pipeline(std::string_view standard);
  Pipeline& pipeline() { return *pipeline_; }
  PipelineOptions pipeline_options();

  /// For --report: facts beside the messages, as JSON.
  void fact(std::string name, std::string json) { facts_.emplace_back(std::move(name), std::move(json)); }

  int exit_code(bool made) const { return !made ? nothing : diag_.has_errors() ? partly : done; }
  /// Prints the messages, writes the report and gives the exit code. `made`: there is an output.
  int end(bool made);

 private:
  bool apply_warning_flags();
  std::shared_ptr<const Scene> parse_inlined(const std::string& path, Diagnostics&);
  void place(Scene&) const;
  bool write_report(int code);

  const Flags& flags_;
  ThreadLimit threads_;
  Diagnostics own_diag_;
  Diagnostics& diag_ = own_diag_;
  Statistics stats_;
  std::unique_ptr<World> world_;
  std::unique_ptr<FileResources> resources_;
  std::vector<FileLookup> buffers_;
  PassContext context_;
  std::optional<Pipeline> pipeline_;
  std::vector<PassTime> times_;
  std::vector<std::pair<std::string, std::string>> facts_;
  Progress progress_;
  bool good_ = true;
};

/// Whole or not at all; false when not, which was printed.
bool write_text_file(const std::string& path, std::string_view text);

/// A scene whose root is scaled to metres and turned Y up; see --unit and --up.
void place_world(Scene&, std::string_view unit, std::string_view up);

}  // namespace wrlkit
