// `kaya lsp`: what an editor asks while a deck is typed (language server protocol 3.17).
#pragma once

namespace kaya {

/// Serves an editor until it ends the conversation, or closes the input. Returns the exit status.
int serve_editor(int input, int output);

} // namespace kaya
