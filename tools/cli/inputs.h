// Which files a corpus run is about: folders, globs, lists and names on the command line, in an order that does not
// depend on the file system.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

struct InputFile {
  std::string path;    // to read it
  std::string inside;  // below its root: where it is in the mirrored tree
  std::uint32_t root = 0;
  std::uint64_t bytes = 0;
  bool mirrored = false;  // all that is next to it in its folder is next to its output, too
  bool asset = false;     // not a scene, but what scenes refer to: a picture, a sound
};

struct InputRules {
  std::vector<std::string> include, exclude;  // globs of names, paths and folders, as given or below the root
  std::string base;                           // paths of lists are mirrored below this folder
  std::string output;                         // a folder that is passed over
  bool assets = false;                        // pictures and sounds as well
};

struct Inputs {
  std::vector<std::string> roots;        // folders; files below them may refer to all that is there
  std::vector<InputFile> files;          // by path, each once
  std::vector<std::string> left_out;     // what is missing or empty, cannot be read, leads nowhere: sentences
  std::vector<std::string> passed_over;  // folders within folders that hold outputs, globs of nothing: sentences
};

/// "plant/", "plant/**/*.wrl", "@list.txt", "-" (a list on standard input), "pump.wrl". In folders and globs only what
/// has the ending of a scene counts, and nothing that is hidden. What is not there is left out, and words that mean no
/// file. Nothing, and why, when there is no scene at all.
std::optional<Inputs> gather_inputs(const std::vector<std::string>& words, const InputRules& rules, std::string& why);

struct NamedWorld {
  std::string path, name;  // of what a folder or a glob has: its path below that
};

/// A folder, a glob that is not the name of a file, or "@list.txt".
bool means_many(const std::string& word);
struct NamedWorlds {
  std::vector<NamedWorld> worlds;
  bool is_list = false;  // more than one word, or one that `means_many`: a list even if it has one scene
  std::vector<std::string> left_out, passed_over;  // as those of Inputs
};

/// Files that are named stand as they are, even those that are not there; what `means_many` as the scenes in it.
/// Nothing, and why, when there is no scene at all.
std::optional<NamedWorlds> named_worlds(const std::vector<std::string>& words, std::string& why);

/// Prints what was left out and passed over, a line each. `partly` when something was left out, otherwise `done`.
int print_left_out(std::string_view verb, const std::vector<std::string>& left_out,
                   const std::vector<std::string>& passed_over);

/// Whether a path below some folder is meant by a glob: "*" within a name, "**" across folders; without "/" it is about
/// the last name alone.
bool glob_matches(const std::string& glob, const std::string& path);

/// "a/b.wrl.gz" without its ending, when that is one of a scene: "a/b"; else nothing.
std::optional<std::string> without_ending(const std::string& path);

/// What --json of a verb prints of these scenes: an object where one is named, otherwise a list of objects.
std::string json_of_scenes(const NamedWorlds& named, const std::vector<std::string>& objects);

}  // namespace wrlkit
