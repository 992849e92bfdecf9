#include "convert/tiles/looks.h"

#include <filesystem>
#include <utility>

#include "base/io/url.h"
#include "scenegraph/nodes.h"

namespace wrlkit::tiles {
namespace {

/// What of a node belongs to its look. A TextureTransform does not: texture coordinates are as it makes them.
bool counts(const Scene& scene, NodeId n, const Value& v) {
  if (scene.is(n, nodes::Appearance) && v.slot == nodes::appearance::textureTransform.slot) return false;
  return !v.is && !scene.is_extra(v) && scene.type(n).fields[v.slot].name != "metadata";
}

bool is_known(const Scene& scene, NodeId n) { return n && scene.type(n).kind == NodeKind::builtin; }

/// Takes an Appearance to another scene. Nesting is bounded by the parser.
class Taking {
 public:
  Taking(const Scene& from, const Task& ctx, Resources* resources) : from_(from), ctx_(ctx), resources_(resources) {}

  /// Everything that makes it what it is, as bytes.
  std::string key(NodeId n) {
    key_.clear();
    add_key(n);
    return std::move(key_);
  }

  /// Of all but the colour that Color nodes stand for. Empty where a texture is mixed with it, or where it is not said
  /// by a Material.
  std::string family_key(NodeId appearance) {
    if (!appearance || from_.get(appearance, nodes::appearance::texture)) return {};
    coloured_ = from_.get(appearance, nodes::appearance::material);
    if (!coloured_ || !from_.is(coloured_, nodes::Material)) return {};
    return key(appearance);
  }

  /// That key() has met.
  const std::vector<std::string>& pictures() const { return pictures_; }

  std::uint64_t picture_bytes() const {
    std::uint64_t sum = inside_bytes_;
    std::error_code fault;
    for (const auto& path : pictures_)
      if (const auto size = std::filesystem::file_size(path, fault); !fault) sum += size;
    return sum;
  }

  /// The same, with the contents of the pictures that key() has met.
  ContentHash hash(std::string key) const {
    for (const auto& path : pictures_) key += hash_of_file(path).value_or(ContentHash{}).hex();
    return hash_of(key);
  }

  NodeId copy(NodeId n, Scene& to) {
    if (!is_known(from_, n)) return {};
    const NodeId made = to.add(from_.type_id(n));
    for (const Value& v : from_.copy_of_fields(n))
      if (counts(from_, n, v)) to.set(made, copy(n, v, to));
    return made;
  }

 private:
  template <class T>
  void add_bytes(std::span<const T> values) {
    const std::uint64_t n = values.size();
    key_.append(reinterpret_cast<const char*>(&n), sizeof n);
    key_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void add_text(std::string_view s) { add_bytes(std::span<const char>(s.data(), s.size())); }

  void add_key(NodeId n) {
    if (!is_known(from_, n)) return add_text("");
    add_text(from_.type(n).name);
    for (const Value& v : from_.fields(n)) {
      if (!counts(from_, n, v) || (n == coloured_ && v.slot == nodes::material::diffuseColor.slot)) continue;
      key_ += static_cast<char>(v.slot);
      const auto element = info(v.type).element;
      if (element == Element::node)
        for (NodeId c : v.node_span()) add_key(c);
      else if (element == Element::number)
        add_bytes(v.number_span());
      else if (element == Element::integer || element == Element::image)
        add_bytes(v.integer_span());
      else if (v.type == FieldType::MFString)
        for (const auto& text : texts(n, v)) add_text(text);
      else
        add_text(v.text());
    }
    key_ += '\xff';
  }

  Value copy(NodeId n, const Value& v, Scene& to) {
    const auto element = info(v.type).element;
    if (element == Element::node) {
      std::vector<NodeId> nodes;
      for (NodeId c : v.node_span())
        if (const NodeId made = copy(c, to)) nodes.push_back(made);
      if (info(v.type).multiple) return to.make(v.type, v.slot, nodes);
      return to.make(v.type, v.slot, nodes.empty() ? NodeId{} : nodes[0]);
    }
    if (element == Element::number) return to.make(v.type, v.slot, v.number_span());
    if (v.type == FieldType::SFBool || v.type == FieldType::SFInt32) return v;
    if (element == Element::integer || element == Element::image) return to.make(v.type, v.slot, v.integer_span());
    if (v.type != FieldType::MFString) return to.make(v.type, v.slot, v.text());
    const auto all = readable(n, texts(n, v));
    return to.make(v.type, v.slot, std::vector<std::string_view>(all.begin(), all.end()));
  }

  /// Of urls, what they lead to from here.
  std::vector<std::string> texts(NodeId n, const Value& v) {
    std::vector<std::string> out;
    const bool is_url = resources_ && from_.is(n, nodes::ImageTexture);
    for (const auto text : v.text_span()) {
      const auto target = is_url ? resources_->target(text, from_.where(n), *from_.sources) : UrlTarget{};
      if (target.kind == UrlTarget::Kind::file) pictures_.push_back(target.path);
      if (is_url && text.starts_with("data:")) inside_bytes_ += text.size() * 3 / 4;  // base64
      out.push_back(target.kind == UrlTarget::Kind::file ? target.path : std::string(text));
    }
    return out;
  }

  /// Without urls that would be looked for from another folder by whoever writes the look.
  std::vector<std::string> readable(NodeId n, std::vector<std::string> all) const {
    if (!resources_ || !from_.is(n, nodes::ImageTexture)) return all;
    const std::string first = all.empty() ? std::string() : all[0];
    bool any_outside = false;
    std::erase_if(all, [&](const std::string& text) {
      if (url_kind(text) != UrlKind::file) return false;
      const auto kind = resources_->target(text, from_.where(n), *from_.sources).kind;
      any_outside |= kind == UrlTarget::Kind::outside;
      return kind == UrlTarget::Kind::outside || kind == UrlTarget::Kind::nothing;
    });
    // Others of the list stand for those that are not there.
    if (all.empty() && !first.empty())
      ctx_.diag.report(any_outside ? Diag::url_outside : Diag::url_not_found, from_.where(n), first);
    return all;
  }

  const Scene& from_;
  const Task& ctx_;
  Resources* resources_;
  std::string key_;
  NodeId coloured_{};  // the Material whose colour does not count
  std::vector<std::string> pictures_;
  std::uint64_t inside_bytes_ = 0;  // of pictures that are in their urls
};

}  // namespace

std::uint32_t Looks::add(const Scene& scene, NodeId appearance, const Task& ctx, Resources* resources) {
  Taking taking(scene, ctx, resources);
  const auto [at, is_new] = known_.try_emplace(taking.key(appearance), static_cast<std::uint32_t>(appearances_.size()));
  if (!is_new) return at->second;
  hashes_.push_back(taking.hash(at->first));
  picture_bytes_.push_back(taking.picture_bytes());
  for (const auto& path : taking.pictures())
    picture_folders_.insert(std::filesystem::path(path).parent_path().string());
  const auto family = taking.family_key(appearance);
  families_.push_back(family.empty() ? at->second : known_families_.try_emplace(family, at->second).first->second);
  n_of_family_.push_back(0);
  ++n_of_family_[families_.back()];
  appearances_.push_back(taking.copy(appearance, scene_));
  return at->second;
}

}  // namespace wrlkit::tiles
