// A behaviour graph of KHR_interactivity (Khronos, ratified 2026), as it is being made and as JSON.
//
// The extension wants values to come from earlier nodes and flows to lead to later ones (its chapter "Node Object
// Validation"). So a step is added behind the nodes that its inputs come from, and a flow is led on by adding the next
// step: both hold by themselves. Babylon.js 9.28 follows no flow behind nodes that set something, so these are the
// ends of a sequence.
#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/math/quaternion.h"
#include "base/text/json.h"
#include "scenegraph/gltf_extensions.h"

namespace wrlkit::gltf {

class Graph {
 public:
  enum class Type : std::uint8_t { boolean, integer, number, vec3, vec4, reference };
  /// Nodes beyond this limit are not added: routes that fan out and meet again multiply.
  static constexpr std::size_t max_nodes = 100'000;

  /// A constant, or what another node gives out.
  struct Value {
    Type type = Type::boolean;
    std::string constant = {};  // elements of a JSON array; none: of a node
    std::uint32_t node = 0;
    std::string_view socket = "value";

    bool is(bool v) const { return type == Type::boolean && constant == (v ? "true" : "false"); }
  };
  static Value value(bool v) { return {Type::boolean, v ? "true" : "false"}; }
  static Value value(std::int32_t v) { return {Type::integer, json_of(v)}; }
  static Value value(double v) { return {Type::number, json_of(finite(v))}; }
  static Value value(const Vec3& v) { return {Type::vec3, elements(Vec3{finite(v[0]), finite(v[1]), finite(v[2])})}; }
  static Value value(const Quaternion& q) { return {Type::vec4, elements(std::array{q.x, q.y, q.z, q.w})}; }
  /// A JSON pointer to an object of the file.
  static Value reference(std::string_view pointer) { return {Type::reference, json_of(pointer)}; }
  static std::string pointer_of(const Value& reference) {
    return reference.constant.substr(1, reference.constant.size() - 2);
  }

  using Inputs = std::vector<std::pair<std::string, Value>>;
  /// Names and JSON values.
  using Configuration = std::vector<std::pair<std::string_view, std::string>>;

  /// An output flow that leads nowhere yet. A flow that is none goes nowhere, and what would follow is not added.
  struct Flow {
    std::uint32_t node = none;
    std::string socket = "out";
    std::uint32_t done = 0;  // of a sequence: so many of its flows lead somewhere, and this is the next
    explicit operator bool() const { return node != none; }
    static constexpr std::uint32_t none = 0xffffffffu;
  };

  /// A node that computes `type` from its inputs.
  Value compute(std::string_view operation, Type type, Inputs inputs, Configuration configuration = {});
  /// A property of the file as it is.
  Value property(const std::string& pointer, Type type);
  /// A node that begins a flow.
  struct Event {
    Flow flow;
    std::uint32_t node;
  };
  Event event(std::string_view operation, Configuration = {});
  /// The next node of a flow, which then goes on from its socket "out".
  std::uint32_t step(Flow&, std::string_view operation, Inputs = {}, Configuration = {});
  /// The two ways on; of a condition that is constant one of them is none.
  struct Branch {
    Flow yes, no;
  };
  Branch branch(Flow, const Value& condition);
  /// What is done one after the other.
  using Part = std::function<void(Flow)>;
  void in_turn(Flow, std::span<const Part>);

  struct Variable {
    std::uint32_t index;
    Type type;
  };
  Variable variable(const Value& initial);
  Value read(Variable v);
  void set(Flow&, Variable, const Value&);
  void set_property(Flow&, const std::string& pointer, const Value&);
  /// Sends an event: to the program that shows the file, where it has an id that this knows.
  void send(Flow&, std::uint32_t event, std::optional<Value> = {});
  /// The event of that id, to be sent or received; without one an event of the graph's own. `carries`: the type of its
  /// value, which is at the socket "value" of the node that receives it.
  std::uint32_t custom_event(const std::string& id = {}, std::optional<Type> carries = {});
  Flow receive(std::uint32_t event);

  bool empty() const { return nodes_.empty(); }
  bool full() const { return nodes_.size() >= max_nodes; }
  /// Does a node or pointer of the graph need it?
  bool uses(GltfExtension) const;
  /// The members of the extension object.
  void write(JsonOut&) const;

 private:
  struct Node {
    std::uint32_t declaration;
    Configuration configuration;
    Inputs inputs;
    std::vector<std::pair<std::string, std::uint32_t>> flows;
  };
  static double finite(double v) { return std::isfinite(v) ? v : 0; }  // JSON has no other
  static std::string elements(const auto& list) {
    std::string text = json_of(list);
    return text.substr(1, text.size() - 2);
  }
  /// None when the graph is full.
  std::uint32_t add(std::string_view operation, Inputs, Configuration);
  void act(Flow&, std::string_view operation, Inputs, Configuration);
  static std::string turn(std::size_t);
  std::uint32_t declaration(std::string_view operation);
  std::uint32_t type_index(Type) const;
  void note_type(Type);
  void write_node(JsonOut&, const Node&) const;
  void write_declaration(JsonOut&, std::string_view operation) const;

  std::vector<Type> types_;
  std::vector<std::string_view> declarations_;
  std::vector<Value> variables_;  // as they are at first
  struct CustomEvent {
    std::string id;
    std::optional<Type> carries;
  };
  std::vector<CustomEvent> events_;
  std::map<std::string, std::uint32_t> event_ids_;
  std::vector<Node> nodes_;
  std::set<GltfExtension> sets_;  // whose properties are set
};

}  // namespace wrlkit::gltf
