// A session that runs lines of a deck and stores its output.
#pragma once

#include "commands/session/session.hpp"

#include <cstdio>
#include <gtest/gtest.h>
#include <string>

namespace kaya {

class Running : public testing::Test {
protected:
    explicit Running(Options options = {}) : results_(std::tmpfile()), messages_(std::tmpfile()) {
        options.threads = 1;
        session_ = std::make_unique<Session>(options, results_, messages_);
    }
    ~Running() override {
        session_.reset();
        std::fclose(results_);
        std::fclose(messages_);
    }

    void run(const std::string& text) { session_->deck.interpreter.run_text(text, "test.3dd"); }

    /// The error that ends the text; its message is "" if there is none.
    Diagnostic mistake(const std::string& text) {
        try {
            run(text);
        } catch (const Diagnostic& problem) { return problem; }
        return Diagnostic("");
    }

    std::string printed() { return all_of(results_); }
    std::string said() { return all_of(messages_); }
    Session& session() { return *session_; }
    Model& model() { return session_->engine.model; }

private:
    static std::string all_of(std::FILE* stream) {
        std::fflush(stream);
        std::rewind(stream);
        std::string text;
        for (int c = std::fgetc(stream); c != EOF; c = std::fgetc(stream)) text += static_cast<char>(c);
        return text;
    }

    std::FILE* results_;
    std::FILE* messages_;
    std::unique_ptr<Session> session_;
};

} // namespace kaya
