// Field values without nodes (annex A, fieldValue): numbers, booleans, images, strings and lists of them, with the
// repairs that real files need.
#pragma once
#include <vector>

#include "parsers/vrml/repeated_lists.h"
#include "parsers/vrml/tokens.h"

namespace wrlkit::vrml {

class Values : protected Tokens {
 protected:
  using Tokens::Tokens;

  /// Reads a value of any type that holds no nodes. `fallback` gives what a value that is too short lacks. False: there
  /// is none, which was reported.
  bool plain_value(FieldType, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out);
  bool string_list(FieldType, std::uint16_t slot, Value& out);
  /// The same as VRML 1.0 writes it.
  bool vrml1_value(FieldType, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out);
  bool enumeration(FieldType, std::uint16_t slot, Value& out);
  /// The text of values up to the next name or bracket that ends them. What is left open in it is closed, so that it
  /// can stand before other text.
  std::string verbatim();
  /// The value a field has when none is given: zeroes and empty lists.
  Value empty_value(FieldType);
  bool image(FieldType, std::uint16_t slot, Value& out);
  /// Numbers or booleans into numbers_ or integers_, up to the first other token; `most` at the most (0: all).
  void read_numbers(FieldType, std::size_t most);
  void fix_arity(std::size_t arity, const Value& fallback, std::string_view field, Span where);
  /// Of what was read, which is as much as the type takes.
  Value value_of_numbers(FieldType, std::uint16_t slot);

  /// The text of a list of numbers, without brackets, if it is written plainly to its end; of an MF type. Where the
  /// same text was read before, it has the same array. `end`: as of read_plain_list. False: nothing was said.
  bool plain_list(std::string_view list, const char* end, FieldType, std::uint16_t slot, Value& out);

  std::vector<double> numbers_;
  std::vector<std::int32_t> integers_;
  std::string_view last_list_;  // that was read, and nothing was said of it

 private:
  struct Numbers {
    const void* data = nullptr;  // null: they were not read without a message
    std::size_t count = 0;
  };
  /// Of that text, as they were read before.
  Numbers& numbers_of(std::string_view list, bool real);
  static Numbers numbers_in(const Value& list);
  static bool take_numbers(const Numbers&, FieldType, std::uint16_t slot, Value& out);
  bool numbers_value(FieldType, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out);
  /// Of a list in brackets. Where the same text was read before, and nothing was said of it, it has the same array.
  bool list_value(FieldType, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out);
  /// What stands behind the next bracket, up to the first ']' that follows, which need not be that of the list.
  std::string_view next_list();
  bool single_string(FieldType, std::uint16_t slot, std::string_view field, Value& out);
  bool bare_string(std::string_view& out);
  bool bare_strings(FieldType, std::uint16_t slot, Value& out);
  template <class T, class Read>
  void numbers(std::vector<T>& to, Read read, std::size_t most);
  void booleans(std::size_t most);
  void number_repaired(const char* from, const char* to, double v);
  /// Behind the values of a list: its ']', or otherwise what is wrong, up to it.
  void close_list(Token opened);

  RepeatedLists repeated_;
  std::vector<Numbers> lists_read_;   // by their ids in repeated_
  Numbers short_list_;                // of one that is not looked up
  const char* next_close_ = nullptr;  // the first ']' behind some place that was read
};

}  // namespace wrlkit::vrml
