// movie: pictures of a view while the model cycles.
#include "commands/session/handlers.hpp"
#include "commands/plot/pictures.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t usual_interval = 100;

/// Settings of a movie line.
struct MovieLine {
    bool on = true;
    std::string file;
    std::int64_t interval = usual_interval;
    std::vector<std::string> unknown;
};

MovieLine read_movie_line(const std::vector<lang::Plot::Item>& words) {
    MovieLine line;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i].folded;
        const bool more = i + 1 < words.size();
        if (word == "on" || word == "start") line.on = true;
        else if (word == "off" || word == "stop" || word == "finish") line.on = false;
        else if ((word == "file" || word == "filename") && more) line.file = words[++i].text;
        else if ((word == "interval" || word == "step" || word == "every" || word == "cycle") && more) {
            const std::string& text = words[++i].text;
            std::int64_t number = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            if (error != std::errc() || end != text.data() + text.size() || number < 1)
                throw Diagnostic(fmt::format("'{}' is not a number of cycles", text),
                                 "write for example: movie on interval 200");
            line.interval = number;
        } else line.unknown.push_back(words[i].text);
    }
    return line;
}

} // namespace

void shoot_movies(Session& session) {
    const std::int64_t cycle = session.engine.model.clock.cycle;
    auto& movies = session.plots.movies;
    for (std::size_t i = 0; i < movies.size(); ++i) {
        Movie& movie = movies[i];
        if (cycle < movie.last) movie.last = cycle; // a model from before was restored
        if (cycle - movie.last < movie.interval) continue;
        movie.last = cycle;
        const std::string file = fmt::format("{}-{:04}.png", movie.stem, ++movie.pictures);
        if (!write_view(session, movie.view, file)) {
            movies.erase(movies.begin() + static_cast<std::ptrdiff_t>(i--)); // the next would fail as well
            continue;
        }
        if (movie.pictures == 1)
            session.program.output.say(fmt::format(
                "movie: {} and so on, one each {} cycles; a clip: ffmpeg -framerate 20 -i {}-%04d.png {}.mp4", file,
                movie.interval, movie.stem, movie.stem));
    }
}

void run(Session& session, const lang::Movie& command) {
    const auto words = with_script_values(session, command.words);
    try {
        const MovieLine line = read_movie_line(words);
        if (!line.unknown.empty())
            session.warn_once(fmt::format("movie ignores '{}'", fmt::join(line.unknown, " ")),
                              "docs/commands/movie.md lists what it reads");
        auto& plots = session.plots;
        if (!line.on) return plots.movies.clear();
        Movie movie;
        movie.view = plots.views[plots.current];
        if (movie.view.items.empty()) movie.view.items.emplace_back().field = "disp";
        const std::string stem = fs::path(session.deck.file).stem().string();
        movie.stem = line.file.empty() ? fmt::format("{}-movie", stem.empty() ? "kaya" : stem)
                                       : fs::path(line.file).replace_extension().string();
        movie.interval = line.interval;
        movie.last = session.engine.model.clock.cycle;
        plots.movies.push_back(std::move(movie));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void add_handlers(HandlerTable& table, lang::MovieCommands list) { fill(table, list); }

} // namespace kaya
