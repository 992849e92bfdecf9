// A file that was read, with all that belongs to it: its scene, the texts that messages point into, the files that it
// refers to, and its messages.
#pragma once
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "base/io/allowed_files.h"
#include "base/io/read_file.h"
#include "convert/messages.h"
#include "convert/options.h"
#include "parsers/parsers.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

/// Watches work that takes long, and may stop it.
struct Watch {
  Monitor* monitor = nullptr;  // null: not watched
  std::stop_token stop{};      // checked between passes, between meshes and in the loops of light
};

/// How something has ended. partly: there is a result, but something of the input could not be used.
enum class Ending : std::uint8_t { good, partly, failed, stopped };

class Document {
 public:
  /// Empty until something is read.
  explicit Document(LoadOptions options = {}, Watch watch = {});
  /// A scene that was made elsewhere, with the messages and files that a pass is given. The context must outlive
  /// the document.
  Document(World world, const PassContext& context);
  /// The same with messages of its own. Files next to it are not known: LoadOptions::allow_paths says where relative
  /// urls may lead.
  explicit Document(World world, LoadOptions options = {}, Watch watch = {});
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  /// Reads a file in place of what was there; "-" is standard input. False when no scene can be read:
  /// messages() say why. O(bytes).
  bool read(const std::string& path);
  /// The same of a file that was read already.
  bool read(const std::string& path, const FileText& file);
  /// The same from memory, not gzipped; `name` is for messages. Bytes have no folder: no file is read but below
  /// LoadOptions::allow_paths, and relative urls are looked for in each of these.
  bool parse(std::string_view bytes, std::string name);

  /// What is read from now on is left as it is by LoadOptions::unit, up, show_all and run_startup: the pipeline that
  /// it goes through has `place`, `switch` and `startup`.
  void leave_unplaced();
  /// LoadOptions::run_startup.
  bool runs_startup() const;

  /// Whether there is a scene.
  explicit operator bool() const;
  /// A document of its own with the same scene, whose arrays are shared; messages go to this one, which must outlive
  /// it.
  Document copy() const;

  /// Takes over the nodes of another document (Scene::import) with what they refer to: the files that it may read may
  /// be read by this one, too, and the files that its passes have made become files of this one. Returns its roots,
  /// ROUTEs and prototypes in this scene's ids; they are shown once they are put into scene().main or below a node.
  Scope import(const Document& other);

  World& world();
  const World& world() const;
  Scene& scene() { return world().scene; }
  const Scene& scene() const { return world().scene; }
  const std::string& path() const;

  Diagnostics& diag() const;
  /// With their places.
  std::vector<MessageView> messages() const { return views(diag()); }
  /// Null until something was read.
  Resources* resources() const;
  /// For passes that are called directly, and for Pipeline::run. It stays where it is when the document is moved.
  PassContext& context();
  /// The other files that were asked for, found or not.
  std::vector<FileLookup> lookups() const;
  /// Reports how many files above the input's folder were found (LoadOptions::project_files), if any.
  void report_files_above();
  Ending ending(bool made) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wrlkit
