#include "tools/cli/inputs.h"

#include <fmt/format.h>
#include <fnmatch.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/blanks.h"
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

/// The first line of a file, where a list has the name of one.
bool begins_a_scene(std::string_view line) {
  constexpr std::string_view begins[] = {"#VRML", "#Inventor", "#X3D", "<", "{", "glTF", "\x1f\x8b"};
  return std::ranges::any_of(begins, [&](std::string_view begin) { return line.starts_with(begin); });
}

bool is_glob(const std::string& word) { return word.find_first_of("*?[") != word.npos; }

/// The first of them, and how many more there are: lists may name any number of files that are not there.
std::string in_one_line(std::span<const std::string> faults) {
  constexpr std::size_t most = 10;
  std::string out;
  for (const auto& fault : faults.first(std::min(most, faults.size()))) out += (out.empty() ? "" : "; ") + fault;
  if (faults.size() > most) out += fmt::format("; and {} more", faults.size() - most);
  return out;
}

/// A pattern of --include or --exclude: "old", "old/" and "./old/**" mean all that is below that folder.
class InputPattern {
 public:
  explicit InputPattern(const std::string& text) : glob_(text) {
    while (glob_.starts_with("./")) glob_.erase(0, 2);
    const bool is_of_folder = glob_.ends_with('/');
    while (glob_.ends_with('/')) glob_.pop_back();
    const auto last = glob_.substr(glob_.rfind('/') + 1);
    names_folder_ = is_of_folder || !is_glob(last);
    names_file_ = !is_of_folder;
  }

  /// A path below the root, and as it was given.
  bool matches(const std::string& inside, const std::string& given) {
    const bool found = (names_file_ && (glob_matches(glob_, inside) || glob_matches(glob_, given))) ||
                       (names_folder_ && (names_folder_of(inside) || (!is_name() && names_folder_of(given))));
    has_matched_ |= found;
    return found;
  }
  bool has_matched() const { return has_matched_; }

 private:
  bool is_name() const { return glob_.find('/') == glob_.npos; }

  bool names_folder_of(const std::string& path) const {
    for (auto folder = fs::path(path).parent_path(); folder.has_relative_path(); folder = folder.parent_path())
      if (glob_matches(glob_, folder.string())) return true;
    return false;
  }

  std::string glob_;
  bool names_file_ = true, names_folder_ = false;
  bool has_matched_ = false;
};

class Gatherer {
 public:
  explicit Gatherer(const InputRules& rules)
      : rules_(rules),
        include_(rules.include.begin(), rules.include.end()),
        exclude_(rules.exclude.begin(), rules.exclude.end()) {
    std::error_code none;
    if (!rules.output.empty()) output_ = fs::weakly_canonical(rules.output, none);
  }

  void word(const std::string& w) {
    n_found_ = 0;
    const auto n_before = out_.left_out.size();
    find(w);
    if (n_found_ == 0 && out_.left_out.size() == n_before) leave_out("there are no scene files in '" + w + "'");
  }

  std::size_t n_unwanted() const { return n_unwanted_; }

  Inputs take() {
    // Named twice, it is still one file.
    std::ranges::stable_sort(out_.files, {}, &InputFile::path);
    std::ranges::sort(out_.left_out);
    say_unmatched("--include", rules_.include, include_);
    say_unmatched("--exclude", rules_.exclude, exclude_);
    auto same = [](const InputFile& a, const InputFile& b) { return a.path == b.path; };
    out_.files.erase(std::unique(out_.files.begin(), out_.files.end(), same), out_.files.end());
    return std::move(out_);
  }

 private:
  void find(const std::string& w) {
    std::error_code none;
    if (w == "-")
      list(std::cin, "standard input");
    else if (w.starts_with('@'))
      list_file(w.substr(1));
    else if (fs::is_directory(w, none))
      folder(w, "");
    else if (fs::is_regular_file(w, none))
      named(w, false);
    else if (is_glob(w))
      glob(w);
    else
      leave_out("there is no file or folder '" + w + "'");
  }

  void leave_out(std::string what) { out_.left_out.push_back(std::move(what)); }

  std::uint32_t root(const fs::path& path) {
    auto name = path.empty() ? std::string(".") : path.lexically_normal().string();
    auto i = std::ranges::find(out_.roots, name);
    if (i == out_.roots.end()) i = out_.roots.insert(i, name);
    return static_cast<std::uint32_t>(i - out_.roots.begin());
  }

  void list_file(const std::string& name) {
    std::error_code none;
    std::ifstream lines(name);
    if (fs::is_directory(name, none))
      leave_out("'" + name + "' is a folder, not a list of files");
    else if (lines)
      list(lines, name);
    else
      leave_out("there is no list '" + name + "'");
  }

  /// A path a line, or with NUL behind each, as find -print0 writes them.
  void list(std::istream& in, const std::string& name) {
    std::error_code none;
    std::string line;
    std::getline(in, line);
    if (begins_a_scene(line) && !fs::exists(line, none))
      return leave_out(name + " is a scene, but a list is expected: the name of a scene in each line; save the scene " +
                       "as a file and name that");
    if (line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    if (line.find('\0') == line.npos) {
      do listed(line, name);
      while (std::getline(in, line));
      return;
    }
    if (!in.eof()) line += '\n';
    line.append(std::istreambuf_iterator<char>(in), {});
    std::istringstream paths(line);
    while (std::getline(paths, line, '\0')) listed(line, name);
  }

  /// Blanks around a path that is not there with them do not count, and lines that begin with '#' are comments.
  void listed(const std::string& line, const std::string& name) {
    std::error_code none;
    const std::string path(fs::exists(line, none) ? line : trim(line));
    const bool is_there = fs::exists(path, none);
    if (path.empty() || (!is_there && path.starts_with('#'))) return;
    if (fs::is_regular_file(path, none))
      named(path, true);
    else if (is_there && fs::is_directory(path, none))
      leave_out(name + ": '" + path + "' is a folder; a list names files");
    else
      leave_out(name + ": there is no file '" + path + "'");
  }

  /// A file by its name, whatever its ending. Those of lists are in the mirrored tree where their paths say.
  void named(const fs::path& path, bool from_list) {
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
    ++n_found_;
    add(path, inside.string(), root(from), false, false);
  }

  void glob(const std::string& word) {
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
    folder(front.empty() ? "." : front.string(), pattern);
  }

  void folder(const std::string& path, const std::string& pattern) {
    const auto at = root(path);
    const auto parts = names_of(pattern);
    const bool is_any_depth = parts.empty() || std::ranges::find(parts, "**") != parts.end();
    std::error_code fault;
    fs::recursive_directory_iterator i(path, fs::directory_options::follow_directory_symlink, fault), end;
    if (fault) return leave_out("cannot read the folder '" + path + "': " + fault.message());
    std::vector<Identity> above{identity(path)};  // of the folders that lead to where the iterator is
    for (; i != end; i.increment(fault)) {
      const auto name = i->path().filename().string();
      std::error_code none;
      const bool is_folder = i->is_directory(none);
      const bool is_too_deep = i.depth() > most_depth || (is_folder && !is_any_depth && !rules_.assets &&
                                                          static_cast<std::size_t>(i.depth()) + 1 >= parts.size());
      if (name.starts_with('.') || is_too_deep ||
          (is_folder && !output_.empty() && fs::weakly_canonical(i->path(), none) == output_)) {
        if (is_folder) i.disable_recursion_pending();
        continue;
      }
      if (is_folder) {
        above.resize(static_cast<std::size_t>(i.depth()) + 1);
        const auto folder = identity(i->path());
        if (std::ranges::find(above, folder) != above.end())
          i.disable_recursion_pending();  // a symbolic link that leads back
        above.push_back(folder);
        if (!can_be_read(i->path()) || holds_outputs(i->path())) i.disable_recursion_pending();
      }
      if (!is_folder) entry(*i, i->path().lexically_relative(path).string(), parts, at);
    }
    if (fault) leave_out("cannot read the folder '" + path + "': " + fault.message());
  }

  /// What a folder has that is not a folder; `glob` is that of the word, in names of the path, empty for all scenes.
  void entry(const fs::directory_entry& file, std::string inside, std::span<const std::string> glob, std::uint32_t at) {
    std::error_code none;
    const auto name = file.path().filename().string();
    const bool is_world = is_scene_name(name),
               is_asset = rules_.assets && !is_world && !ending_of(name, asset_endings).empty();
    if (!is_asset && !(glob.empty() ? is_world : match(glob, names_of(inside)))) return;
    if (file.is_symlink(none) && !file.exists(none)) {
      if (is_world && wanted(inside, file.path()))
        leave_out("'" + file.path().string() + "' is a link to a file that is not there");
      return;
    }
    if (!file.is_regular_file(none)) return;
    ++n_found_;
    const bool is_wanted = is_asset || wanted(inside, file.path());
    n_unwanted_ += !is_wanted;
    if (is_wanted) add(file.path(), std::move(inside), at, is_asset || rules_.assets, is_asset);
  }

  /// Of an earlier corpus run or of `tiles`: the scenes in it would be there twice. A word that names the folder itself
  /// means it.
  bool holds_outputs(const fs::path& folder) {
    std::error_code none;
    if (!fs::is_directory(folder / ".wrlkit", none) && !fs::exists(folder / "tileset.json", none)) return false;
    out_.passed_over.push_back("'" + folder.string() + "' holds outputs of wrlkit and is passed over");
    return true;
  }

  bool can_be_read(const fs::path& folder) {
    std::error_code fault;
    const fs::directory_iterator begun(folder, fault);
    if (fault) leave_out("cannot read the folder '" + folder.string() + "': " + fault.message());
    return !fault;
  }

  bool wanted(const std::string& inside, const fs::path& path) {
    const auto given = path.lexically_normal().string();
    const auto n_matching = [&](std::vector<InputPattern>& all) {  // all are asked, to know which mean nothing
      return std::ranges::count_if(all, [&](InputPattern& p) { return p.matches(inside, given); });
    };
    const bool is_included = n_matching(include_) > 0 || include_.empty();
    return n_matching(exclude_) == 0 && is_included;
  }

  void say_unmatched(std::string_view option, std::span<const std::string> given, std::span<const InputPattern> all) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!all[i].has_matched())
        out_.passed_over.push_back(fmt::format("{} '{}' matches none of the scene files", option, given[i]));
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
  std::vector<InputPattern> include_, exclude_;
  fs::path output_;
  std::size_t n_found_ = 0;     // by the word that is looked at; --include and --exclude may take them away
  std::size_t n_unwanted_ = 0;  // those that they took away, of all words
  Inputs out_;
};

}  // namespace

std::optional<Inputs> gather_inputs(const std::vector<std::string>& words, const InputRules& rules, std::string& why) {
  Gatherer gatherer(rules);
  for (const auto& w : words) gatherer.word(w);
  auto out = gatherer.take();
  if (!std::ranges::all_of(out.files, &InputFile::asset)) return out;
  if (gatherer.n_unwanted() > 0)
    why = fmt::format("none of {} scene files matches --include and --exclude", gatherer.n_unwanted());
  else
    why = out.left_out.empty() ? "there are no scene files in '" + words[0] + "'" : in_one_line(out.left_out);
  return std::nullopt;
}

bool means_many(const std::string& word) {
  std::error_code none;
  return word.starts_with('@') || fs::is_directory(word, none) ||
         (word.find_first_of("*?") != word.npos && !fs::exists(word, none));
}

std::optional<NamedWorlds> named_worlds(const std::vector<std::string>& words, std::string& why) {
  const InputRules rules;
  NamedWorlds out;
  out.is_list = words.size() != 1 || means_many(words[0]);
  for (const auto& word : words) {
    if (!means_many(word)) {
      out.worlds.push_back({word, word == "-" ? "standard input" : fs::path(word).filename().string()});
      continue;
    }
    Gatherer gatherer(rules);
    gatherer.word(word);
    auto found = gatherer.take();
    for (auto& file : found.files) out.worlds.push_back({file.path, file.inside});
    std::ranges::move(found.left_out, std::back_inserter(out.left_out));
    std::ranges::move(found.passed_over, std::back_inserter(out.passed_over));
  }
  if (!out.worlds.empty()) return out;
  why = in_one_line(out.left_out);
  return std::nullopt;
}

std::string json_of_scenes(const NamedWorlds& named, const std::vector<std::string>& objects) {
  if (!named.is_list && objects.size() == 1) return objects[0];
  return fmt::format("[{}]", fmt::join(objects, ",\n"));
}

int print_left_out(std::string_view verb, const std::vector<std::string>& left_out,
                   const std::vector<std::string>& passed_over) {
  for (const auto& folder : passed_over) fmt::print(stderr, "wrlkit {}: {}\n", verb, folder);
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
