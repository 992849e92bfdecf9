#include "parsers/x3d/xml.h"

#include <cstring>
#include <functional>
#include <pugixml.hpp>

namespace wrlkit::x3d {
namespace {

/// pugixml works in a copy of the text, which it cuts up; offsets in the copy are offsets in the text.
class Flattener {
 public:
  Flattener(std::string_view text, const std::string& copy, XmlTree& tree) : text_(text), copy_(copy.data()), tree_(tree) {}

  void run(pugi::xml_node document) {
    tree_.nodes.emplace_back();
    std::vector<std::uint32_t> last{XmlNode::none}, open{0};
    for (pugi::xml_node n = document.first_child(); n;) {
      if (auto id = add(n); id != XmlNode::none) {
        (last.back() == XmlNode::none ? tree_.nodes[open.back()].first_child : tree_.nodes[last.back()].next) = id;
        last.back() = id;
        if (n.first_child()) {
          open.push_back(id);
          last.push_back(XmlNode::none);
          n = n.first_child();
          continue;
        }
      }
      while (!n.next_sibling() && n.parent() != document) n = n.parent(), open.pop_back(), last.pop_back();
      n = n.next_sibling();
    }
  }

 private:
  /// What pugixml never read, in a text that is cut off, is a constant of its own.
  std::string_view view(const char* p) const {
    const bool inside = !std::less<>{}(p, copy_) && !std::less<>{}(copy_ + text_.size(), p);
    return inside ? text_.substr(static_cast<std::size_t>(p - copy_), std::strlen(p)) : text_.substr(text_.size());
  }

  std::uint32_t add(pugi::xml_node n) {
    XmlNode out;
    switch (n.type()) {
      case pugi::node_element:
        out.name = view(n.name());
        out.first_attribute = static_cast<std::uint32_t>(tree_.attributes.size());
        for (auto a : n.attributes()) tree_.attributes.push_back({view(a.name()), view(a.value())});
        out.n_attributes = static_cast<std::uint32_t>(tree_.attributes.size()) - out.first_attribute;
        break;
      case pugi::node_cdata:
      case pugi::node_pcdata:
        out.kind = XmlNode::Kind::text;
        out.cdata = n.type() == pugi::node_cdata;
        out.content = view(n.value());
        break;
      case pugi::node_comment:
        out.kind = XmlNode::Kind::comment;
        out.content = view(n.value());
        break;
      default:
        return XmlNode::none;
    }
    tree_.nodes.push_back(out);
    return static_cast<std::uint32_t>(tree_.nodes.size() - 1);
  }

  std::string_view text_;
  const char* copy_;
  XmlTree& tree_;
};

}  // namespace

XmlTree read_xml(std::string_view text) {
  XmlTree tree;
  std::string copy(text);
  pugi::xml_document document;
  // No conversion of entities and line ends: values keep their length and place.
  auto result = document.load_buffer_inplace(copy.data(), copy.size(), pugi::parse_cdata | pugi::parse_comments, pugi::encoding_utf8);
  if (!result) tree.fault = result.description(), tree.fault_at = static_cast<std::size_t>(result.offset);
  Flattener(text, copy, tree).run(document);
  return tree;
}

}  // namespace wrlkit::x3d
