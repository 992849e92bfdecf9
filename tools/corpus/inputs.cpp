#include "tools/corpus/inputs.h"

#include <fmt/format.h>
#include <fnmatch.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "convert/formats.h"
#include "tools/cli/flags.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view asset_endings[] = {".png",  ".jpg",  ".jpeg", ".gif", ".bmp", ".tga",  ".tif", ".tiff",
                                              ".webp", ".exr",  ".hdr",  ".dds", ".wav", ".mp3",  ".mid", ".midi",
                                              ".mpg",  ".mpeg", ".mp4",  ".avi", ".js",  ".class"};

bool is_scene_name(std::string_view name) { return !ending_of(name, scene_endings()).empty(); }

std::vector<std::string> names_of(const std::string& path) {
  std::vector<std::string> names;
  for (const auto& n : fs::path(path)) names.push_back(n.string());
  return names;
}

bool match(std::span<const std::string> glob, std::span<const std::string> names) {
  if (glob.empty()) return names.empty();
  if (glob[0] == "**") return match(glob.subspan(1), names) || (!names.empty() && match(glob, names.subspan(1)));
  return !names.empty() && fnmatch(glob[0].c_str(), names[0].c_str(), 0) == 0 &&
         match(glob.subspan(1), names.subspan(1));
}

bool is_glob(const std::string& word) { return word.find_first_of("*?[") != word.npos; }

class Gatherer {
 public:
  Gatherer(const InputRules& rules, std::string& why) : rules_(rules), why_(why) {
    std::error_code none;
    if (!rules.output.empty()) output_ = fs::weakly_canonical(rules.output, none);
  }

  bool word(const std::string& w) {
    if (w == "-") return list(std::cin, "standard input");
    if (w.starts_with('@')) {
      std::ifstream file(w.substr(1));
      return file ? list(file, w.substr(1)) : fail("there is no list '" + w.substr(1) + "'");
    }
    std::error_code none;
    if (fs::is_directory(w, none)) return folder(w, "");
    if (fs::is_regular_file(w, none)) return named(w, false);
    if (is_glob(w)) return glob(w);
    return leave_out("there is no file or folder '" + w + "'");
  }

  Inputs take() {
    // Named twice, it is still one file.
    std::ranges::stable_sort(out_.files, {}, &InputFile::path);
    std::ranges::sort(out_.left_out);
    auto same = [](const InputFile& a, const InputFile& b) { return a.path == b.path; };
    out_.files.erase(std::unique(out_.files.begin(), out_.files.end(), same), out_.files.end());
    return std::move(out_);
  }

 private:
  bool fail(std::string what) {
    why_ = std::move(what);
    return false;
  }

  bool leave_out(std::string what) {
    out_.left_out.push_back(std::move(what));
    return true;
  }

  std::uint32_t root(const fs::path& path) {
    auto name = path.empty() ? std::string(".") : path.lexically_normal().string();
    auto i = std::ranges::find(out_.roots, name);
    if (i == out_.roots.end()) i = out_.roots.insert(i, name);
    return static_cast<std::uint32_t>(i - out_.roots.begin());
  }

  bool list(std::istream& lines, const std::string& name) {
    for (std::string line; std::getline(lines, line);) {
      if (line.ends_with('\r')) line.pop_back();
      if (line.empty()) continue;
      std::error_code none;
      if (fs::is_regular_file(line, none))
        named(line, true);
      else
        leave_out(name + ": there is no file '" + line + "'");
    }
    return true;
  }

  /// A file by its name, whatever its ending. Those of lists are in the mirrored tree where their paths say.
  bool named(const fs::path& path, bool from_list) {
    std::error_code none;
    auto inside = path.filename();
    fs::path from = path.parent_path();
    if (from_list) {
      const auto base = rules_.base.empty() ? fs::path(".") : fs::path(rules_.base);
      const auto relative = fs::proximate(path, base, none).lexically_normal();
      if (!none && !relative.empty() && *relative.begin() != ".." && !relative.is_absolute()) {
        inside = relative;
        from = base;
      }
    }
    add(path, inside.string(), root(from), false, false);
    return true;
  }

  bool glob(const std::string& word) {
    fs::path front;
    std::string pattern;
    for (const auto& n : fs::path(word))
      if (pattern.empty() && !is_glob(n.string()))
        front /= n;
      else
        pattern += (pattern.empty() ? "" : "/") + n.string();
    std::error_code none;
    if (!fs::is_directory(front.empty() ? "." : front, none))
      return leave_out("there is no folder '" + front.string() + "'");
    // Without "/" a glob here is about the names in that folder, not below it.
    return folder(front.empty() ? "." : front.string(), pattern);
  }

  bool folder(const std::string& path, const std::string& pattern) {
    const auto at = root(path);
    const auto parts = names_of(pattern);
    std::error_code fault;
    fs::recursive_directory_iterator i(path, fs::directory_options::follow_directory_symlink, fault), end;
    if (fault) return leave_out("cannot read the folder '" + path + "': " + fault.message());
    std::vector<Identity> above{identity(path)};  // of the folders that lead to where the iterator is
    for (; i != end; i.increment(fault)) {
      const auto name = i->path().filename().string();
      std::error_code none;
      const bool is_folder = i->is_directory(none);
      if (name.starts_with('.') ||
          (is_folder && !output_.empty() && fs::weakly_canonical(i->path(), none) == output_) ||
          i.depth() > most_depth) {
        if (is_folder) i.disable_recursion_pending();
        continue;
      }
      if (is_folder) {
        above.resize(static_cast<std::size_t>(i.depth()) + 1);
        const auto folder = identity(i->path());
        if (std::ranges::find(above, folder) != above.end())
          i.disable_recursion_pending();  // a symbolic link that leads back
        above.push_back(folder);
        if (!can_be_read(i->path())) i.disable_recursion_pending();
      }
      if (i->is_symlink(none) && !fs::exists(i->path(), none) && is_scene_name(name))
        leave_out("'" + i->path().string() + "' is a link to a file that is not there");
      if (is_folder || !i->is_regular_file(none)) continue;
      auto inside = i->path().lexically_relative(path).string();
      const bool is_world = is_scene_name(name),
                 is_asset = rules_.assets && !is_world && !ending_of(name, asset_endings).empty();
      if (is_asset)
        add(i->path(), std::move(inside), at, true, true);
      else if (pattern.empty() ? is_world && wanted(inside) : match(parts, names_of(inside)) && wanted(inside))
        add(i->path(), std::move(inside), at, rules_.assets, false);
    }
    return !fault ||
           fail("cannot read the folder '" + path + "': " + fault.message());  // nothing is left out in silence
  }

  bool can_be_read(const fs::path& folder) {
    std::error_code fault;
    const fs::directory_iterator begun(folder, fault);
    if (fault) leave_out("cannot read the folder '" + folder.string() + "': " + fault.message());
    return !fault;
  }

  bool wanted(const std::string& inside) const {
    const auto matches = [&](const std::string& g) { return glob_matches(g, inside); };
    return (rules_.include.empty() || std::ranges::any_of(rules_.include, matches)) &&
           std::ranges::none_of(rules_.exclude, matches);
  }

  void add(const fs::path& path, std::string inside, std::uint32_t root, bool mirrored, bool asset) {
    std::error_code none;
    out_.files.push_back(
        {path.lexically_normal().string(), std::move(inside), root, fs::file_size(path, none), mirrored, asset});
  }

  using Identity = std::pair<dev_t, ino_t>;
  static Identity identity(const fs::path& path) {
    struct stat there {};
    return stat(path.c_str(), &there) == 0 ? Identity{there.st_dev, there.st_ino} : Identity{};
  }

  static constexpr int most_depth = 64;
  const InputRules& rules_;
  std::string& why_;
  fs::path output_;
  Inputs out_;
};

}  // namespace

std::optional<Inputs> gather_inputs(const std::vector<std::string>& words, const InputRules& rules, std::string& why) {
  Gatherer gatherer(rules, why);
  for (const auto& w : words)
    if (!gatherer.word(w)) return std::nullopt;
  auto out = gatherer.take();
  if (!out.files.empty() || out.left_out.empty()) return out;
  for (const auto& fault : out.left_out) why += (why.empty() ? "" : "; ") + fault;
  return std::nullopt;
}

bool means_many(const std::string& word) {
  std::error_code none;
  return word.starts_with('@') || fs::is_directory(word, none) ||
         (word.find_first_of("*?") != word.npos && !fs::exists(word, none));
}

std::optional<NamedWorlds> named_worlds(const std::vector<std::string>& words, std::string& why) {
  NamedWorlds out;
  for (const auto& word : words) {
    if (!means_many(word)) {
      out.worlds.push_back({word, word == "-" ? "standard input" : fs::path(word).filename().string()});
      continue;
    }
    auto found = gather_inputs({word}, {}, why);
    if (!found) return std::nullopt;
    if (found->files.empty()) {
      why = "there are no scene files in '" + word + "'";
      return std::nullopt;
    }
    for (auto& file : found->files) out.worlds.push_back({file.path, file.inside});
    std::ranges::move(found->left_out, std::back_inserter(out.left_out));
  }
  return out;
}

int print_left_out(std::string_view verb, const std::vector<std::string>& left_out) {
  for (const auto& fault : left_out) fmt::print(stderr, "wrlkit {}: {}\n", verb, fault);
  return left_out.empty() ? done : partly;
}

bool glob_matches(const std::string& glob, const std::string& path) {
  if (glob.find('/') == glob.npos) return fnmatch(glob.c_str(), fs::path(path).filename().c_str(), 0) == 0;
  return match(names_of(glob), names_of(path));
}

std::optional<std::string> without_ending(const std::string& path) {
  const auto e = ending_of(fs::path(path).filename().string(), scene_endings());
  return e.empty() ? std::nullopt : std::optional(path.substr(0, path.size() - e.size()));
}

}  // namespace wrlkit
