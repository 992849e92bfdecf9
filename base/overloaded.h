// One visitor made of several functions, for std::visit.
#pragma once

namespace wrlkit {

template <typename... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <typename... F>
Overloaded(F...) -> Overloaded<F...>;  // Clang before 17 does not find it by itself

}  // namespace wrlkit
