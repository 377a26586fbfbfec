// The border between C++ and Lua. Lua jumps over C++ frames, so no C++ exception may leave a function that
// Lua calls, and no function of ours raises a Lua error while it holds objects.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/script/base/lua_headers.hpp"

#include <new>

namespace kaya::script {

/// Leaves a value on the stack that represents the diagnostic while Lua unwinds.
void push_diagnostic(lua_State* L, const Diagnostic& diagnostic);
/// The diagnostic at `index`, or null when another value was thrown.
const Diagnostic* diagnostic_at(lua_State* L, int index);
/// Makes the type of such values.
void open_diagnostics(lua_State* L);

/// Lua calls this in place of `body`: exceptions become Lua errors.
template <int (*body)(lua_State*)> int guarded(lua_State* L) {
    try {
        return body(L);
    } catch (const Diagnostic& diagnostic) { push_diagnostic(L, diagnostic); } catch (const std::bad_alloc&) {
        push_diagnostic(L, Diagnostic("there is not enough memory for this model",
                                      "use fewer blocks or longer zone edges", Fault::run));
    } catch (const std::exception& error) { push_diagnostic(L, Diagnostic(error.what(), {}, Fault::own)); }
    return lua_error(L);
}

/// Runs the function below its `arguments` on the stack. A Lua error becomes a Diagnostic with the place in the deck and the stack of
/// functions.
void call_protected(lua_State* L, int arguments, int results);

/// Loads Lua text; a mistake in it is thrown with its place.
void load_text(lua_State* L, const std::string& text, const std::string& chunk_name);

} // namespace kaya::script
