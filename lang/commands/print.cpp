#include "lang/commands/print.hpp"

#include "lang/commands/language.hpp"
#include "lang/commands/printer.hpp"
#include "lang/interp/binder.hpp"

namespace kaya::lang {

namespace {

/// The only statement of a text; nothing when it has mistakes, or more statements.
std::optional<BoundCommand> only_command(const std::string& text, const Language& dialect) {
    try {
        Lexer lexer(source_from_text("", text));
        Statement statement, further;
        if (!next_statement(dialect, lexer, statement)) return std::nullopt;
        BoundCommand bound = bind_statement(dialect, statement);
        if (lexer.next(further)) return std::nullopt;
        return bound;
    } catch (const Diagnostic&) { return std::nullopt; }
}

/// The words of the name alone.
Statement name_statement(const CommandSpec& spec) {
    Lexer lexer(source_from_text("", spec.name()));
    Statement statement;
    lexer.next(statement);
    return statement;
}

/// What follows the name of a command; nothing when its words cannot say it.
std::optional<PrintedWords> words_after_name(const CommandSpec& spec, std::any command) {
    const void* wanted = spec.address(command);
    const auto holder = std::make_shared<std::any>(spec.make());
    std::shared_ptr<void> present(holder, spec.address(*holder));
    if (spec.start) spec.start(name_statement(spec), present.get());
    StructPrinter printer(wanted, present, spec.hash);
    if (!printer.print(spec.arguments)) return std::nullopt;
    auto keywords = pointers_to(spec.keywords);
    keywords.insert(spec.values_last ? keywords.end() : keywords.begin(), &spec.values);
    printer.print(keywords);
    Wording wording = std::move(printer).result();
    if (spec.range_of && spec.range_elements != nullptr) {
        const RangePhrase* phrase = spec.range_of(wanted);
        StructPrinter of_range(phrase, std::make_shared<RangePhrase>(*spec.range_of(wording.after.get())),
                               hash_struct<RangePhrase>);
        of_range.print(pointers_to(*spec.range_elements));
        Wording range = std::move(of_range).result();
        if (!range.words.empty()) wording.words.push_back({"range"});
        wording.words.insert(wording.words.end(), range.words.begin(), range.words.end());
    }
    return std::move(wording.words);
}

std::optional<std::string> line_of(const CommandSpec& spec, std::any command, const Language& dialect) {
    const auto same = [&](const std::string& line) {
        const auto read = only_command(line, dialect);
        return read && !read->late && struct_text(read->command) == struct_text(command);
    };
    if (spec.whole_line) {
        std::string line = spec.whole_line(spec.address(command));
        return same(line) ? std::optional(line) : std::nullopt;
    }
    const auto words = words_after_name(spec, command);
    if (!words) return std::nullopt;
    const bool quotes = &dialect != &classic(); // as users of the modern dialect write
    for (const bool quote_all_names : {quotes, !quotes}) {
        std::string line = spec.name();
        if (!words->empty()) line += " " + joined(*words, quote_all_names);
        if (same(line)) return line;
    }
    return std::nullopt;
}

} // namespace

std::optional<std::string> line_of(const std::any& command, const Language& dialect) {
    std::optional<std::string> line;
    for_each_command(dialect, [&](const CommandSpec& spec) {
        if (!line && spec.support != Support::not_yet && spec.make().type() == command.type())
            line = line_of(spec, command, dialect);
    });
    return line;
}

} // namespace kaya::lang
