#include "tools/cli/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <ranges>

#include "base/io/read_file.h"
#include "base/text/nearest_name.h"
#include "convert/formats.h"
#include "passes/pipeline/pipeline.h"
#include "tools/cli/cli.h"
#include "tools/cli/python_passes.h"
#include "tools/cli/toml.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_bytes = 1 << 20;

// How a run is watched is not a matter of the recipe.
constexpr std::string_view not_in_recipes[] = {
    "help",        "recipe",      "python", "pipeline", "print-pipeline", "print-recipe", "verify-each",
    "print-after", "time-passes", "stats",  "output",   "quiet",          "verbose",      "json",
    "report",      "jobs",        "base",   "shard",    "joblog",         "retry",        "bundle"};
constexpr std::string_view of_input[] = {"unit", "up", "allow-path", "include", "exclude"};
constexpr std::string_view of_limits[] = {"memory", "timeout"};
constexpr std::string_view of_messages[] = {"strict"};
constexpr std::string_view keys_of_passes[] = {"python", "pipeline", "pass"};
constexpr std::string_view sections[] = {"input", "output", "limits", "messages"};

bool contains(auto&& list, std::string_view name) { return std::ranges::find(list, name) != std::end(list); }

struct RecipeOption : OptionHelp {
  std::string_view verb;  // whose it is
};

/// Options of the command line that recipes may say.
std::vector<RecipeOption> recipe_options() {
  std::vector<RecipeOption> all;
  for (std::string_view verb : {"convert", "corpus-run"})
    for (auto& o : options_of(verb))
      if (!recipe_section(o.name).empty() && std::ranges::find(all, o.name, &OptionHelp::name) == all.end())
        all.push_back({std::move(o), verb});
  return all;
}

class Reader {
 public:
  Reader(const std::string& path, std::string_view text, bool with_passes, std::string& why)
      : path_(path), text_(text), with_passes_(with_passes), why_(why) {}

  std::optional<Recipe> read() {
    TomlPlace where;
    std::string fault;
    const auto root = parse_toml(text_, fault, where);
    if (!root) {
      fail(where, fault);
      return std::nullopt;
    }
    recipe_.path = path_;
    if (const auto* files = root->find("python"); files && with_passes_ && !python(*files))
      return std::nullopt;  // the passes below are in them
    for (const auto& member : root->items)
      if (!top(member)) return std::nullopt;
    if (!passes_.empty()) recipe_.pipeline = passes_;
    return std::move(recipe_);
  }

 private:
  bool fail(TomlPlace where, std::string_view what) {
    why_ = fmt::format("{}:{}:{}: error: {}\n", path_, where.line, where.column, what);
    std::size_t begin = 0;
    for (std::size_t line = 1; line < where.line && begin < text_.size(); ++line)
      begin = std::min(text_.find('\n', begin), text_.size() - 1) + 1;
    const auto line = text_.substr(begin, text_.find('\n', begin) - begin);
    if (where.line) why_ += fmt::format("{:>6} | {}\n       | {:>{}}\n", where.line, line, '^', where.column);
    return false;
  }
  bool unknown(const TomlNode& node, std::string_view what, const NearestName& nearest) {
    return fail(node.key_place, fmt::format("{}{}", what, nearest.question()));
  }
  bool want(const TomlNode& node, TomlNode::Kind kind) {
    return node.kind == kind || fail(node.place, fmt::format("'{}' is {}, and should be {}", node.key,
                                                             to_string(node.kind), to_string(kind)));
  }

  bool top(const TomlNode& node) {
    using enum TomlNode::Kind;
    if (!with_passes_ && contains(keys_of_passes, node.key)) return true;
    if (node.key == "python") return true;
    if (node.key == "summary") {
      recipe_.summary = node.text;
      return want(node, text);
    }
    if (node.key == "pipeline") return want(node, text) && pipeline(node);
    if (node.key == "pass") {
      if (node.kind != list) return fail(node.key_place, "passes are written as [[pass]]");
      return std::ranges::all_of(node.items, [&](const TomlNode& n) { return pass(n); });
    }
    if (contains(sections, node.key))
      return want(node, table) && std::ranges::all_of(node.items, [&](const TomlNode& n) {
               return node.key == "messages" && n.key != "strict" ? message(n) : option(node.key, n);
             });
    NearestName nearest(node.key);
    nearest.consider("summary");
    for (auto name : keys_of_passes) nearest.consider(name);
    for (auto name : sections) nearest.consider(name);
    return unknown(node, fmt::format("a recipe has no '{}'", node.key), nearest);
  }

  bool python(const TomlNode& node) {
    using enum TomlNode::Kind;
    if (node.kind == boolean || node.kind == number) return want(node, text);
    std::vector<std::string> names;
    std::string fault;
    if (!texts(node, names)) return false;
    std::error_code none;
    for (const auto& name : names)
      recipe_.python.push_back(fs::absolute(fs::path(path_).parent_path() / name, none).lexically_normal().string());
    return load_python_passes(recipe_.python, fault) || fail(node.place, fault);
  }

  bool only_one_pipeline(TomlPlace where) {
    return !(recipe_.pipeline && !passes_.empty()) ||
           fail(where, "the passes are given twice: as a pipeline and one by one");
  }

  bool pipeline(const TomlNode& node) {
    std::string fault;
    if (!Pipeline::parse(node.text, fault)) return fail(node.place, fault);
    recipe_.pipeline = node.text;
    return only_one_pipeline(node.key_place);
  }

  bool pass(const TomlNode& node) {
    using enum TomlNode::Kind;
    if (node.kind != table) return fail(node.place, "passes are written as [[pass]]");
    const auto* name = node.find("name");
    if (!name) return fail(node.place, "this pass has no name");
    if (!want(*name, text)) return false;
    std::string fault;
    if (!Pipeline::parse(name->text, fault) || !find_pass(name->text))
      return fail(name->place, fault.empty() ? fmt::format("'{}' is a pipeline, no pass", name->text) : fault);
    const auto info = find_pass(name->text);
    const auto instance = info->make();
    std::string options;
    for (const auto& o : node.items) {
      if (o.key == "name") continue;
      std::string value;
      if (!value_of_pass(o, value)) return false;
      if (!instance->set(o.key, value, fault))
        return fail(fault.starts_with("has no option") ? o.key_place : o.place,
                    fmt::format("pass '{}' {}", name->text, fault));
      options += fmt::format("{}{}={}", options.empty() ? "" : ",", o.key, quoted_value(value));
    }
    passes_ +=
        fmt::format("{}{}{}", passes_.empty() ? "" : ",", name->text, options.empty() ? "" : "{" + options + "}");
    return only_one_pipeline(node.place);
  }

  /// Lists have colons between their items.
  bool value_of_pass(const TomlNode& node, std::string& value) {
    using enum TomlNode::Kind;
    if (node.kind == table) return want(node, text);
    value = node.text;
    for (const auto& item : node.items) {
      if (item.kind == table || item.kind == list)
        return fail(item.place, fmt::format("{} cannot stand here", to_string(item.kind)));
      value += (value.empty() ? "" : ":") + item.text;
    }
    return true;
  }

  bool texts(const TomlNode& node, std::vector<std::string>& values) {
    using enum TomlNode::Kind;
    if (node.kind == table) return want(node, text);
    if (node.kind != list) {
      values = {node.text};
      return true;
    }
    for (const auto& item : node.items) {
      if (item.kind == table || item.kind == list)
        return fail(item.place, fmt::format("{} cannot stand here", to_string(item.kind)));
      values.push_back(item.text);
    }
    return true;
  }

  /// Whether it is about how much is done at a time, which no recipe says.
  static bool is_of_the_run(const std::string& name) {
    return std::ranges::any_of(options_of("corpus-run"), [&](const OptionHelp& o) { return o.name == name; });
  }

  bool option(std::string_view section, const TomlNode& node) {
    const auto known = recipe_options();
    NearestName nearest(node.key);
    for (const auto& o : known) nearest.consider(o.name);
    const auto found = std::ranges::find(known, node.key, &OptionHelp::name);
    if (found == known.end() && is_of_the_run(node.key))
      return fail(node.key_place,
                  fmt::format("'{}' is an option of the command line: wrlkit corpus run --{}", node.key, node.key));
    if (found == known.end()) return unknown(node, fmt::format("[{}] has no '{}'", section, node.key), nearest);
    if (auto right = recipe_section(node.key); right != section)
      return fail(node.key_place, fmt::format("'{}' belongs to [{}]", node.key, right));
    std::vector<std::string> values;
    std::string fault;
    if (found->type == flag_type && !want(node, TomlNode::Kind::boolean)) return false;
    if (!texts(node, values)) return false;
    if (!check_option(found->verb, node.key, values, fault)) {
      const auto option = fmt::format("--{}: ", node.key);
      return fail(node.place, fault.starts_with(option) ? fault.substr(option.size()) : fault);
    }
    recipe_.options.emplace_back(node.key, std::move(values));
    return true;
  }

  bool message(const TomlNode& node) {
    if (node.key != "error" && node.key != "ignore") {
      NearestName nearest(node.key);
      for (auto name : {"error", "ignore", "strict"}) nearest.consider(name);
      return unknown(node, fmt::format("[messages] has no '{}'", node.key), nearest);
    }
    std::vector<std::string> names;
    if (!texts(node, names)) return false;
    for (const auto& name : names) {
      Diag id{};
      NearestName nearest(name);
      for (const auto& d : all_diags()) nearest.consider(d.name);
      if (!find_diag(name, id))
        return fail(node.place, fmt::format("there is no message '{}'{}", name, nearest.question()));
      recipe_.warnings.push_back((node.key == "error" ? "error=" : "no-") + name);
    }
    return true;
  }

  const std::string& path_;
  std::string_view text_;
  bool with_passes_;
  std::string& why_;
  Recipe recipe_;
  std::string passes_;
};

std::string list_of(const std::vector<std::string>& values) {
  std::string out;
  for (const auto& v : values) out += (out.empty() ? "" : ", ") + toml_value(v);
  return values.size() == 1 ? out : "[" + out + "]";
}

/// "\nerror = [...]", of the names of messages that are to be that.
std::string names_behind(const std::vector<std::string>& warnings, std::string_view prefix, std::string_view key) {
  std::vector<std::string> names;
  for (const auto& w : warnings)
    if (w.starts_with(prefix)) names.push_back(w.substr(prefix.size()));
  return names.empty() ? "" : fmt::format("{} = {}\n", key, list_of(names));
}

constexpr std::string_view where_recipes_stand = " (a file .toml; corpus run takes it first, then the inputs)";

std::optional<Recipe> read(const std::string& path, bool with_passes, std::string& why) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    why = fmt::format("wrlkit: '{}' is a folder, not a recipe{}\n", path, where_recipes_stand);
    return std::nullopt;
  }
  if (!ending_of(path, scene_endings()).empty()) {
    why = fmt::format("wrlkit: '{}' is a scene, not a recipe{}\n", path, where_recipes_stand);
    return std::nullopt;
  }
  const auto text = read_bytes(path, most_bytes, why);
  if (!text) {
    why = fmt::format("wrlkit: {}: {}\n", path, why);
    return std::nullopt;
  }
  return Reader(path, *text, with_passes, why).read();
}

}  // namespace

std::string_view recipe_section(std::string_view option) {
  if (contains(not_in_recipes, option)) return "";
  return contains(of_input, option)      ? "input"
         : contains(of_limits, option)   ? "limits"
         : contains(of_messages, option) ? "messages"
                                         : "output";
}

std::optional<Recipe> read_recipe(const std::string& path, std::string& why) { return read(path, true, why); }
std::optional<Recipe> read_recipe_options(const std::string& path, std::string& why) { return read(path, false, why); }

std::string recipe_text(const GivenOptions& options, const std::vector<std::string>& warnings,
                        const Pipeline& pipeline) {
  std::string out;
  if (const auto python = std::ranges::find(options, "python", &GivenOptions::value_type::first);
      python != options.end())
    out += fmt::format("python = {}\n\n", list_of(python->second));
  // [input] says what `place` does, which is put in front again.
  const bool is_placed =
      std::ranges::any_of(options, [](const auto& o) { return o.first == "unit" || o.first == "up"; });
  auto steps = pipeline.steps();
  std::erase_if(steps, [&](const auto& step) { return is_placed && step.name == "place"; });
  if (steps.empty()) out += "pipeline = \"\"\n\n";
  for (auto section : sections) {
    std::string keys;
    for (const auto& [name, values] : options)
      if (recipe_section(name) == section) keys += fmt::format("{} = {}\n", name, list_of(values));
    const bool strict = std::ranges::any_of(options, [](const auto& o) { return o.first == "strict"; });
    if (section == "messages" && contains(warnings, "error") && !strict) keys += "strict = true\n";
    if (section == "messages")
      keys += names_behind(warnings, "error=", "error") + names_behind(warnings, "no-", "ignore");
    if (!keys.empty()) out += fmt::format("[{}]\n{}\n", section, keys);
  }
  for (const auto& step : steps) {
    out += fmt::format("[[pass]]\nname = \"{}\"\n", step.name);
    for (const auto& o : step.options) out += fmt::format("{} = {}\n", o.name, toml_value(o.value));
    out += '\n';
  }
  return out;
}

namespace {

/// A '|' would begin the next column of a table.
std::string in_table(std::string text) {
  for (auto at = text.find('|'); at != text.npos; at = text.find('|', at + 2)) text.insert(at, 1, '\\');
  return text;
}

}  // namespace

std::string recipes_page() {
  std::string out =
      "# Recipes\n\nGenerated from the options of the command line by `script/docs`; do not edit. A recipe is a TOML "
      "file: sections with options of "
      "`wrlkit convert` and of `wrlkit corpus run`, and passes, one `[[pass]]` with its `name` and its options after "
      "the other, or all in one line as `pipeline = \"weld,lod\"`. "
      "`python = [\"tags.py\"]` names files with passes in Python ([python.md](python.md)), from the folder of the "
      "recipe; they stand below `[[pass]]` like all others. "
      "`convert --recipe FILE` runs it, `--print-recipe` prints the whole of what a command would do as a recipe. What "
      "stands on the command line "
      "comes before what the recipe says. `recipes/` has some; [passes.md](passes.md) has the passes with their "
      "options.\n"
      "\n```\nsummary = \"what it is for\"\n\n[output]\nprecision = 6\n\n[[pass]]\nname = \"weld\"\ntolerance = "
      "0.001\n\n[[pass]]\nname = \"lod\"\nratios = [0.5, 0.1]\n```\n";
  const auto options = recipe_options();
  for (auto section : sections) {
    out += fmt::format("\n## [{}]\n\n| key | values | |\n|---|---|---|\n", section);
    for (const auto& o : options)
      if (recipe_section(o.name) == section) out += fmt::format("| {} | {} | {} |\n", o.name, in_table(o.type), o.help);
    if (section == "messages")
      out +=
          "| error | names of messages | these are errors ([diagnostics.md](diagnostics.md) has them all) |\n| ignore "
          "| names of messages | these are dropped |\n";
  }
  return out;
}

}  // namespace wrlkit
