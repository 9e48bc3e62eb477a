// The scenes that can be opened beside the one on show, and the opening of them, which takes its time and may
// fail, while the window goes on.
#pragma once

#include "viewer/opening.hpp"

#include <future>
#include <memory>

namespace sinew::viewer {

/// One thread uses it; it loads in another, and its destructor waits for that.
class Library {
public:
    /// `options` as the program was started with. Offered are the scene files beside the one opened, or those
    /// built in.
    explicit Library(Options options);

    /// What the first scene is opened with.
    const Options& options() const { return options_; }
    /// What the one on show was opened with.
    const Options& shown() const { return shown_->options; }
    const std::vector<std::string>& names() const { return names_; }
    /// Of the scene on show, or of none (-1).
    std::size_t current() const { return current_; }

    /// Begins to open another scene for a picture `aspect` wide; nothing while one is being opened.
    void open(std::size_t name, float aspect);
    /// The one before (-1) or after (+1) in the list, round its ends.
    void openNext(int by, float aspect);
    /// A scene or a mesh: as on the command line.
    void openFile(const std::string& file, float aspect);
    /// The scene on show once more, as it was turned: with another solver or other substeps, all else that
    /// was asked for as before.
    void reopen(const scenes::Overrides& overrides, const Again& again, float aspect);

    bool isOpening() const { return opening_.valid(); }
    /// What was asked for, once it is there; until then nothing. Throws app::Failure and what scenes::load
    /// throws: the scene on show is then still the current one.
    std::unique_ptr<Opening> take();
    /// After take(), where what it gave could not be shown: what was on show before is the current one again.
    void putBack();

private:
    struct Request {
        Options options;
        std::size_t name;
        std::optional<Again> again = {};
    };
    void begin(Request request, float aspect);

    Options options_;
    std::vector<std::string> names_, files_; // no files: built in
    std::size_t current_;
    std::optional<Request> shown_, before_, asked_;
    std::future<std::unique_ptr<Opening>> opening_;
};

} // namespace sinew::viewer
