#include "convert/messages.h"

namespace wrlkit {

std::string MessageView::str() const {
  std::string out = file;
  if (!file.empty() && line) out += ":" + std::to_string(line) + ":" + std::to_string(column);
  if (!out.empty()) out += ": ";
  return out + std::string(to_string(severity)) + ": " + text + " [" + name + "]";
}

std::vector<MessageView> views(const Diagnostics& diag) {
  std::vector<MessageView> out;
  for (const auto& m : diag.messages()) {
    const Place p = diag.sources().locate(m.where);
    const bool exact = p.line && m.where.length;
    out.push_back(
        {m.severity, info(m.id).name, m.text(), std::string(p.file), exact ? p.line : 0, exact ? p.column : 0});
  }
  return out;
}

}  // namespace wrlkit
