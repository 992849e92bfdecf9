// One run of a verb over one scene, or one after the other: messages, files it may read, progress, report and exit
// code.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "convert/document.h"
#include "passes/pipeline/pipeline.h"
#include "tools/cli/flags.h"
#include "tools/cli/progress.h"

namespace wrlkit {

class Session {
 public:
  explicit Session(const Flags&);

  /// False when a flag makes no sense; that was printed.
  bool good() const { return good_; }
  const Flags& flags() const { return flags_; }
  Diagnostics& diag() { return document_.diag(); }
  Document& document() { return document_; }
  /// After read() has found something.
  Resources& resources() { return *document_.resources(); }
  /// The files of the scene that was read last, which outputs do not replace; null when nothing was found.
  const FilesRead* files_read() { return document_.resources() ? &document_.resources()->files_read() : nullptr; }
  PassContext& context() { return document_.context(); }
  Progress& progress() { return progress_; }

  /// Reads a scene, in place of the one before; false when nothing can be read. What a browser would not draw of it is
  /// reported.
  bool read(const std::string& path);
  World& world() { return document_.world(); }
  /// -p with what it lacks of `standard`, otherwise `standard`; false when it is not a pipeline, which was printed.
  bool choose_pipeline(std::string_view standard);
  Pipeline& pipeline() { return *pipeline_; }
  /// Whether the pipeline, when there is one, has that pass.
  bool runs(std::string_view pass) const;
  /// Whether it turns Switches of the world on or off.
  bool chooses_switches() const;
  PipelineOptions pipeline_options();
  /// True after --print-pipeline, with which a verb ends here.
  bool printed_pipeline() const;

  /// For --report: facts in addition to the messages, as JSON.
  void fact(std::string name, std::string json) { facts_.emplace_back(std::move(name), std::move(json)); }

  /// What --json has on standard output: one document, and a line break.
  void print_json(std::string_view json);
  /// The caller prints the JSON of several sessions as one document.
  void leave_json() { has_json_ = true; }

  int exit_code(bool made, int not_made) const {
    return !made ? not_made : document_.diag().has_errors() ? partly : done;
  }
  /// Messages are printed as a line for each kind, unless --verbose says more.
  void be_brief() { brief_ = !flags_.verbose; }
  /// Prints the messages, writes the report and gives the exit code. `made`: there is an output. With --json a run that
  /// has printed nothing, as it has failed, prints what the report says.
  /// `at_least`: what is known of it otherwise, as of several scenes.
  int end(bool made, int not_made = nothing, int at_least = done);

 private:
  LoadOptions load_options();
  std::string report_json(int code);

  const Flags& flags_;
  ThreadLimit threads_;
  bool good_ = true, brief_ = false, has_json_ = false;
  Progress progress_;
  Document document_;
  std::optional<Pipeline> pipeline_;
  std::vector<PassTime> times_;
  std::vector<std::pair<std::string, std::string>> facts_;
};

/// What stands behind -W: "error", "error=lost" (all that is lost), "error=NAME", "no-NAME". False when there is no
/// message of that name.
bool apply_warning_flag(LoadOptions&, const std::string& flag);

/// Whole or not at all; false when not, which was printed.
bool write_text_file(const std::string& path, std::string_view text);

}  // namespace wrlkit
