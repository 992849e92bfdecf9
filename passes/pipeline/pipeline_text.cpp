// The text form of pipelines.
#include <algorithm>
#include <set>
#include <utility>

#include "base/text/backslash.h"
#include "base/text/blanks.h"
#include "passes/pipeline/pipeline.h"

namespace wrlkit {
namespace {

/// Up to the first `stop` outside of braces and quotes; the rest stays behind it. Quotes open where a value begins.
std::string_view cut(std::string_view& rest, char stop) {
  int depth = 0;
  bool quoted = false;
  char before = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const char c = rest[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"' && (quoted || before == '='))
      quoted = !quoted;
    if (static_cast<unsigned char>(c) > ' ') before = c;
    if (quoted) continue;
    if (c == '{') ++depth;
    if (c == '}') --depth;
    if (c == stop && depth == 0) {
      const auto head = rest.substr(0, i);
      rest.remove_prefix(i + 1);
      return trim(head);
    }
  }
  return trim(std::exchange(rest, {}));
}

/// False when its quotes do not end where it ends.
bool unquote(std::string_view text, std::string& value) {
  value.clear();
  if (!text.starts_with('"')) {
    value = text;
    return true;
  }
  std::size_t i = 1;
  for (; i < text.size() && text[i] != '"'; ++i) {
    if (text[i] == '\\') ++i;
    if (i < text.size()) value += text[i];
  }
  return i + 1 == text.size();
}

bool has_option(const PassInstance& pass, std::string_view name) {
  const auto options = pass.options();
  return std::ranges::find(options, name, &OptionInfo::name) != options.end();
}

bool set_options(PassInstance& pass, std::string_view list, std::string& why) {
  std::string value;
  std::set<std::string, std::less<>> given;
  while (!trim(list).empty()) {
    const auto option = cut(list, ',');
    const auto equals = option.find('=');
    const auto name = trim(option.substr(0, equals));
    if (!unquote(equals == option.npos ? "true" : trim(option.substr(equals + 1)), value)) {
      why = "option '" + std::string(name) + "': a quote is missing";
      return false;
    }
    // ratios=0.5,0.2 is ratios=0.5:0.2
    for (auto rest = list; equals != option.npos && !trim(rest).empty(); list = rest) {
      const auto item = cut(rest, ',');
      if (item.empty() || item.find('=') != item.npos || has_option(pass, item)) break;
      (value += ':') += item;
    }
    if (!given.emplace(name).second) {
      why = "option '" + std::string(name) + "' is given twice";
      return false;
    }
    if (!pass.set(name, value, why)) {
      if (value.find(';') != value.npos) why += "; commas separate options: {a=1,b=2}";
      return false;
    }
  }
  return true;
}

std::string no_such_pass(std::string_view name) {
  std::string out = "there is no pass '" + std::string(name) + "'";
  const auto first = name.substr(0, name.find(' '));
  if (first != name && find_pass(first)) return out + "; commas separate passes: weld,lod";
  const auto front = name.substr(0, name.find_first_of("([<:="));
  if (front != name && find_pass(front))
    return out + "; options are in braces: " + std::string(front) + "{option=value,option=value}";
  const auto question = pass_question(name);
  return out + (question.empty() ? "; wrlkit passes lists them" : question);
}

}  // namespace

std::string quoted_value(std::string_view value) {
  if (value.find_first_of(",{}\"\\") == value.npos && trim(value) == value) return std::string(value);
  return in_quotes(value);
}

std::optional<Pipeline> Pipeline::parse(std::string_view text, std::string& why) {
  Pipeline p;
  if (!p.append(text, why)) return std::nullopt;
  return p;
}

bool Pipeline::append(std::string_view text, std::string& why) {
  while (!trim(text).empty()) {
    const bool ends_early = trim(text).ends_with(',');
    const auto item = cut(text, ',');
    if (item.empty() || (ends_early && trim(text).empty())) {
      why = "a pass is missing at a comma";
      return false;
    }
    const auto brace = item.find('{');
    const auto name = trim(item.substr(0, brace));
    if (auto n = std::ranges::find(named_pipelines(), item, &NamedPipeline::name); n != named_pipelines().end()) {
      if (!append(n->text, why)) return false;
      continue;
    }
    const auto* info = find_pass(name);
    if (!info) {
      why = no_such_pass(name);
      return false;
    }
    Step s{info, info->make()};
    if (brace != item.npos) {
      if (item.back() != '}') {
        const auto end = item.rfind('}');
        why = end == item.npos ? "'}' is missing behind '" + std::string(name) + "'"
                               : "'" + std::string(trim(item.substr(end + 1))) + "' behind the '}' of '" +
                                     std::string(name) + "' is not understood; commas separate passes: weld,lod";
        return false;
      }
      if (!set_options(*s.pass, item.substr(brace + 1, item.size() - brace - 2), why)) {
        why = "pass '" + std::string(name) + "' " + why;
        return false;
      }
    }
    steps_.push_back(std::move(s));
  }
  return true;
}

bool Pipeline::add(std::string_view name, const std::vector<std::pair<std::string, std::string>>& options,
                   std::string& why) {
  auto* info = find_pass(name);
  if (!info) {
    why = no_such_pass(name);
    return false;
  }
  Step s{info, info->make()};
  for (const auto& [option, value] : options)
    if (!s.pass->set(option, value, why)) {
      why = "pass '" + std::string(name) + "' " + why;
      return false;
    }
  steps_.push_back(std::move(s));
  return true;
}

bool Pipeline::put_first(std::string_view name, const std::vector<std::pair<std::string, std::string>>& options,
                         std::string& why) {
  const bool has = std::ranges::any_of(steps_, [&](const Step& s) { return s.info->name == name; });
  if (has || options.empty()) return true;
  if (!add(name, options, why)) return false;
  std::rotate(steps_.begin(), steps_.end() - 1, steps_.end());
  return true;
}

bool Pipeline::set(std::string_view name, std::string_view option, std::string_view value, std::string& why) {
  return std::ranges::all_of(steps_, [&](Step& s) { return s.info->name != name || s.pass->set(option, value, why); });
}

std::vector<Pipeline::StepInfo> Pipeline::steps() const {
  std::vector<StepInfo> out;
  for (const auto& s : steps_) out.push_back({s.info->name, s.pass->options()});
  return out;
}

std::vector<std::string> Pipeline::files() const {
  std::vector<std::string> out;
  for (const auto& s : steps_)
    for (auto& file : s.pass->files()) out.push_back(std::move(file));
  return out;
}

std::vector<WrittenFileOption> Pipeline::written_files() const {
  std::vector<WrittenFileOption> out;
  for (const auto& s : steps_)
    for (auto& [option, file] : s.pass->written_files())
      out.push_back({std::string(s.info->name) + "{" + std::string(option) + "=...}", std::move(file)});
  return out;
}

std::string Pipeline::text() const {
  std::string out;
  for (const auto& [name, options] : steps()) {
    out += (out.empty() ? "" : ",") + std::string(name);
    for (std::size_t i = 0; i < options.size(); ++i)
      out += (i ? "," : "{") + options[i].name + "=" + quoted_value(options[i].value);
    if (!options.empty()) out += "}";
  }
  return out;
}

}  // namespace wrlkit
