#include "tools/script_host/engine.h"

#include <duktape.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "base/text/json.h"

extern "C" const char wrlkit_annex_c_begin[], wrlkit_annex_c_end[];

namespace wrlkit {
namespace {

/// Memory of the engine, counted: each block is preceded by its size.
struct Memory {
  std::size_t most, used = 0;
};

constexpr std::size_t head = alignof(std::max_align_t);

void* resize(void* udata, void* old, duk_size_t size) {
  auto& memory = *static_cast<Memory*>(udata);
  char* const block = old ? static_cast<char*>(old) - head : nullptr;
  std::size_t before = 0;
  if (block) std::memcpy(&before, block, sizeof before);
  if (size == 0) {
    std::free(block);
    memory.used -= before;
    return nullptr;
  }
  size += head;
  if (size > memory.most || memory.used - before + size > memory.most) return nullptr;
  char* const made = static_cast<char*>(std::realloc(block, size));
  if (!made) return nullptr;
  memory.used += size - before;
  std::memcpy(made, &size, sizeof size);
  return made + head;
}
void* allocate(void* udata, duk_size_t size) { return size ? resize(udata, nullptr, size) : nullptr; }
void release(void* udata, void* block) {
  if (block) resize(udata, block, 0);
}

/// An error outside of every call of ours, which is memory that is not enough for the engine itself.
[[noreturn]] void end_process(void*, const char*) { _exit(ScriptEngine::out_of_memory); }

std::string text_at(duk_context* ctx, duk_idx_t at) {
  duk_size_t n = 0;
  const char* const text = duk_safe_to_lstring(ctx, at, &n);
  return {text, n};
}

}  // namespace

struct ScriptEngine::State {
  Memory memory;
  Ask ask;
  duk_context* heap = nullptr;
};

namespace {

/// ask(request): the one function of the environment that leads outside.
duk_ret_t ask(duk_context* ctx) {
  duk_push_heap_stash(ctx);
  duk_get_prop_string(ctx, -1, "ask");
  const auto& answer = *static_cast<ScriptEngine::Ask*>(duk_get_pointer(ctx, -1));
  duk_size_t n = 0;
  const char* const request = duk_require_lstring(ctx, 0, &n);
  const std::string out = answer({request, n});
  duk_push_lstring(ctx, out.data(), out.size());
  return 1;
}

/// Runs annex_c.js: the function that it returns, in the heap's stash, begins environments.
duk_ret_t make_types(duk_context* ctx, void* answer) {
  duk_push_heap_stash(ctx);
  duk_push_pointer(ctx, answer);
  duk_put_prop_string(ctx, -2, "ask");
  duk_push_string(ctx, "annex_c.js");
  duk_compile_lstring_filename(ctx, DUK_COMPILE_EVAL, wrlkit_annex_c_begin,
                               static_cast<duk_size_t>(wrlkit_annex_c_end - wrlkit_annex_c_begin));
  duk_call(ctx, 0);
  duk_push_c_function(ctx, ask, 1);
  duk_call(ctx, 1);
  duk_put_prop_string(ctx, -2, "begin");
  return 0;
}

struct Program {
  std::string_view fields, text;
};

/// In the context of the new environment: the types, its fields, then the program.
duk_ret_t begin_environment(duk_context* ctx, void* udata) {
  const auto& program = *static_cast<const Program*>(udata);
  duk_push_global_stash(ctx);
  duk_push_heap_stash(ctx);
  duk_get_prop_string(ctx, -1, "begin");
  duk_remove(ctx, -2);
  duk_push_global_object(ctx);
  duk_call(ctx, 1);
  duk_dup(ctx, -1);
  duk_put_prop_string(ctx, -3, "calls");
  duk_push_string(ctx, "load");
  duk_push_lstring(ctx, program.fields.data(), program.fields.size());
  duk_call_prop(ctx, -3, 1);
  duk_push_string(ctx, "script");
  duk_compile_lstring_filename(ctx, 0, program.text.data(), program.text.size());
  duk_call(ctx, 0);
  return 0;
}

duk_ret_t call_function(duk_context* ctx, void* udata) {
  const auto call = *static_cast<const std::string_view*>(udata);
  duk_push_global_stash(ctx);
  duk_get_prop_string(ctx, -1, "calls");
  duk_push_string(ctx, "call");
  duk_push_lstring(ctx, call.data(), call.size());
  duk_call_prop(ctx, -3, 1);
  return 1;
}

/// The context of an environment, which the heap's stash holds; null: there is none. One value is left on the stack.
duk_context* environment(duk_context* heap, std::uint32_t id) {
  duk_push_heap_stash(heap);
  duk_get_prop_index(heap, -1, id);
  duk_remove(heap, -2);
  return duk_get_context(heap, -1);
}

}  // namespace

ScriptEngine::ScriptEngine(std::size_t most_memory, Ask ask) : state_(new State{{most_memory}, std::move(ask)}) {
  state_->heap = duk_create_heap(allocate, resize, release, &state_->memory, end_process);
  if (!state_->heap || duk_safe_call(state_->heap, make_types, &state_->ask, 0, 1) != 0) end_process(nullptr, nullptr);
  duk_pop(state_->heap);
}

ScriptEngine::~ScriptEngine() { duk_destroy_heap(state_->heap); }

std::string ScriptEngine::load(std::uint32_t id, std::string_view fields, std::string_view text) {
  duk_context* const heap = state_->heap;
  Program program{fields, text};
  struct Job {
    std::uint32_t id;
    Program* program;
    std::string error;
  } job{id, &program, {}};
  const auto make = [](duk_context* ctx, void* udata) -> duk_ret_t {
    auto& job = *static_cast<Job*>(udata);
    duk_push_heap_stash(ctx);
    duk_push_thread_new_globalenv(ctx);
    duk_context* const inner = duk_get_context(ctx, -1);
    duk_put_prop_index(ctx, -2, job.id);
    if (duk_safe_call(inner, begin_environment, job.program, 0, 1) != 0) job.error = text_at(inner, -1);
    duk_set_top(inner, 0);
    return 0;
  };
  if (duk_safe_call(heap, make, &job, 0, 1) != 0) job.error = text_at(heap, -1);
  duk_pop(heap);
  return job.error;
}

std::string ScriptEngine::call(std::uint32_t id, std::string_view call) {
  duk_context* const heap = state_->heap;
  std::string out;
  if (duk_context* const inner = environment(heap, id)) {
    const bool failed = duk_safe_call(inner, call_function, &call, 0, 1) != 0;
    out = text_at(inner, -1);
    duk_set_top(inner, 0);
    if (failed) {
      std::string json;
      JsonOut to(json);
      to.begin_object();
      to.member("error", out);
      to.end_object();
      out = std::move(json);
    }
  }
  duk_pop(heap);
  return out;
}

void ScriptEngine::drop(std::uint32_t id) {
  duk_push_heap_stash(state_->heap);
  duk_del_prop_index(state_->heap, -1, id);
  duk_pop(state_->heap);
}

}  // namespace wrlkit
