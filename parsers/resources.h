// What scenes refer to, from files: found by their urls, read below the allowed folders and nowhere else, each one
// once. Nothing is ever fetched from a network.
#pragma once
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/io/allowed_files.h"
#include "base/io/read_file.h"
#include "scenegraph/resources.h"

namespace wrlkit {

struct ResourceOptions {
  std::string input = "-";                 // that is converted: files below its folder may be read; empty: none is
  std::vector<std::string> allowed = {};   // and below these (--allow-path)
  bool project = false;                    // and linked files as far up as its project reaches (io/project_folder.h)
  bool in_place = false;                   // the input may be replaced
  std::uint64_t max_bytes = 512 << 20;     // of one picture
  std::uint64_t cached_bytes = 512 << 20;  // of files and decoded pictures that are kept for the next request
};

/// Calls may come from several threads, each with a Diagnostics of its own or none at the same time. A node's fault is
/// reported once, however many passes ask for its url.
class FileResources final : public Resources {
 public:
  /// Parses a scene; reports, and returns null, when no scene can be read.
  using ParseWorld = std::function<std::shared_ptr<const Scene>(const std::string& path, Diagnostics&)>;

  FileResources(ResourceOptions options, ParseWorld parse);
  /// The scene that was read from options.input: a request for that file gets this very scene, which tells a scene that
  /// contains itself.
  void set_root(std::shared_ptr<const Scene> scene);

  std::shared_ptr<const Blob> bytes(std::span<const std::string_view> urls, Span where, Diagnostics&) override;
  std::shared_ptr<const Image> image(std::span<const std::string_view> urls, Span where, Diagnostics&) override;
  /// Parsed scenes are kept. A scene that asks for itself while it is being parsed is a cycle.
  LinkedWorld world(std::span<const std::string_view> urls, Span where, Diagnostics&) override;
  std::shared_ptr<const PatchSet> patches(const std::string& path, Diagnostics&) override;
  UrlTarget target(std::string_view url, Span where, const Sources&) override;
  std::shared_ptr<const Scene> look_into(const std::string& path) override;
  std::unique_ptr<Scene> parse(std::string_view text, const std::string& name, const ParseLimits&,
                               Diagnostics&) override;

  /// How many files above the input's folder were found, and below which folder such files may lie.
  std::size_t files_above() const;
  const std::string& project() const { return project_; }
  /// All that was asked for until now: what the result depends on in addition to the input. What has no referrer was
  /// named by the user.
  std::vector<FileLookup> lookups() const;

  /// That of the input, and those that were allowed.
  std::vector<std::string> folders() const override;
  void allow(const std::vector<std::string>&) override;

 protected:
  void forget(const std::string& url) override;

 private:
  struct Target;
  struct Failure;
  template <class T>
  struct Slot;
  template <class T>
  using Slots = std::map<std::string, std::shared_ptr<Slot<T>>>;
  struct ParsedWorld {
    bool parsing = false;
    std::shared_ptr<const Scene> scene;
  };

  template <class T, class Load>
  std::shared_ptr<const T> first_of(std::span<const std::string_view> urls, Span where, Diagnostics&, Load load);
  Target locate(std::string_view url, Span where, const Sources&);
  template <class... A>
  void report_once(Diagnostics&, Diag, Span where, std::string_view url, const A&... more);

  template <class T, class Load>
  std::shared_ptr<const T> once(Slots<T>&, const Target&, std::string& why, Load load);
  template <class T>
  void keep(const std::shared_ptr<const T>&);
  std::shared_ptr<const Blob> blob(const Target&, std::string& why);
  std::shared_ptr<const Image> picture(const Target&, std::string& why);
  std::shared_ptr<const Scene> parsed(const Target&, std::string_view url, Span where, Diagnostics&);

  ResourceOptions options_;
  ParseWorld parse_;
  // Held while a url is looked up and while a scene is parsed, which may ask for further ones: sources that are being
  // added are then not searched. Order of locks: this one, one of a Slot (picture before blob), cache_mutex_.
  std::recursive_mutex mutex_;
  AllowedFiles files_;
  std::string project_;
  std::map<std::pair<std::string, std::string>, AllowedFiles::Result> looked_up_;  // referrer and url
  std::set<std::string> patch_files_;
  std::map<std::string, ParsedWorld> worlds_;
  std::set<std::pair<std::uint32_t, std::string>> reported_;
  std::mutex cache_mutex_;
  Slots<Blob> blobs_;
  Slots<Image> images_;
  std::deque<std::pair<std::shared_ptr<const void>, std::size_t>> kept_;  // the oldest first
  std::size_t kept_bytes_ = 0;
};

}  // namespace wrlkit
