// Lists a folder and loads in a thread.
#include "viewer/jobs/scene_loader.hpp"

#include "scenes/built_in.hpp"
#include "viewer/jobs/replay.hpp"
#include "viewer/ui/preferences.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <tuple>

namespace sinew::viewer {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t none = static_cast<std::size_t>(-1);
constexpr const char* frameOfMeshes = "drop_mesh"; // drops a given mesh, has no body of its own

// Scene files in a folder, by name; empty if it cannot be read.
std::vector<fs::path> sceneFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
         entry.increment(error))
        if (entry->path().extension() == ".toml" && entry->path().stem() != frameOfMeshes &&
            entry->is_regular_file(error))
            files.push_back(entry->path());
    std::ranges::sort(files);
    return files;
}

constexpr std::size_t mostRead = 100'000; // of a file, for its first sentence and marks [bytes]

std::string headOf(const fs::path& file) {
    std::string head(mostRead, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    return head;
}

struct Listed {
    std::string name, file, sentence; // no file: built in
    scenes::Gallery mark;
};

Listed listed(const std::string& name, const std::string& file, std::string_view text) {
    return {name, file, firstSentence(text), scenes::galleryOf(text)};
}

std::vector<Listed> listedFiles(const fs::path& folder) {
    std::vector<Listed> all;
    for (const fs::path& file : sceneFiles(folder))
        all.push_back(listed(file.stem().string(), file.string(), headOf(file)));
    return all;
}

std::vector<Listed> listedBuiltIn() {
    std::vector<Listed> all;
    for (const std::string_view name : scenes::builtInNames())
        if (name != frameOfMeshes) all.push_back(listed(std::string(name), "", scenes::builtInText(name)));
    return all;
}

} // namespace

std::string firstSentence(std::string_view text) {
    std::string sentence;
    while (text.starts_with('#')) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        line.remove_prefix(std::min(line.find_first_not_of("# "), line.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        sentence.append(sentence.empty() || line.empty() ? "" : " ").append(line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (const std::size_t stop = sentence.find(". "); stop != std::string::npos) sentence.resize(stop + 1);
    return sentence;
}

SceneLoader::SceneLoader(Options options, Prepare prepare, Draw draw)
    : options_(std::move(options)), prepare_(std::move(prepare)), current_(none),
      previews_(
          [this, draw = std::move(draw), started = options_](std::size_t name, const std::stop_token& stop) {
              return draw ? draw(ofScene(started, name), stop) : std::nullopt;
          }) {
    const fs::path opened = options_.scene;
    std::vector<Listed> all =
        opened.extension() == ".toml" ? listedFiles(opened.parent_path()) : std::vector<Listed>();
    if (all.empty()) all = listedBuiltIn();
    std::ranges::stable_sort(all, {}, [](const Listed& one) {
        return std::tuple(one.mark.isStudy, !one.mark.isFirst(), one.mark.order);
    });
    for (const Listed& one : all) {
        const bool isOpened = one.file.empty() ? opened.empty() && one.name == options_.builtIn
                                               : fs::path(one.file).filename() == opened.filename();
        if (isOpened) current_ = names_.size();
        names_.push_back(one.name);
        sentences_.push_back(one.sentence);
        marks_.push_back(one.mark);
        if (!one.file.empty()) files_.push_back(one.file);
    }
    shown_ = Request{options_, current_};
    remember(*shown_);
}

void SceneLoader::open(std::size_t name, float aspect) {
    if (name >= names_.size()) return;
    begin({ofScene(options_, name), name}, aspect);
}

Options SceneLoader::ofScene(Options options, std::size_t name) const {
    options.scene = files_.empty() ? "" : files_[name];
    options.builtIn = names_[name];
    options.overrides = {};
    return options;
}

void SceneLoader::openNext(int by, float aspect) {
    if (names_.empty()) return;
    const std::size_t count = names_.size();
    const std::size_t first = by > 0 ? 0 : count - 1; // if none is current
    open(current_ == none
             ? first
             : (current_ + count + static_cast<std::size_t>(by + static_cast<int>(count))) % count,
         aspect);
}

void SceneLoader::openFile(const std::string& file, float aspect) {
    Options options = options_;
    options.scene = file;
    options.overrides = {};
    begin({std::move(options), none}, aspect);
}

void SceneLoader::reopen(const scenes::Overrides& overrides, const ReloadRequest& reload, float aspect) {
    Request request{shown_->options, shown_->name, reload};
    if (overrides.solver) request.options.overrides.solver = overrides.solver;
    if (overrides.substeps) request.options.overrides.substeps = overrides.substeps;
    begin(std::move(request), aspect);
}

void SceneLoader::reopenOn(const std::string& device, const ReloadRequest& reload, float aspect) {
    Request request{shown_->options, shown_->name, reload};
    request.options.device = device;
    begin(std::move(request), aspect);
}

void SceneLoader::moveTo(const std::string& device) {
    shown_->options.device = options_.device = device;
}

void SceneLoader::playAgain(const InputFile& input, float aspect) {
    begin({shown_->options, shown_->name, std::nullopt, input}, aspect);
}

void SceneLoader::remember(const Request& shown) {
    const std::string file = rememberedScene(shown.options.scene, "");
    if (shown.name != none || file.empty()) return;
    std::erase(recent_, file);
    recent_.insert(recent_.begin(), file);
    recent_.resize(std::min(recent_.size(), Preferences::mostRecent));
}

void SceneLoader::addRecent(const std::vector<std::string>& files) {
    for (const std::string& file : files)
        if (std::ranges::count(recent_, file) == 0 && recent_.size() < Preferences::mostRecent)
            recent_.push_back(file);
}

void SceneLoader::begin(Request request, float aspect) {
    if (isOpening()) return;
    asked_ = std::move(request);
    opening_ = std::async(std::launch::async, [asked = *asked_, aspect, this] {
        auto opening = std::make_unique<OpenedScene>(viewer::open(asked.options, aspect));
        opening->reload = asked.reload;
        if (asked.input) prepareForReplay(*opening, *asked.input);
        opening->input = asked.input;
        if (prepare_) prepare_(*opening, asked.options);
        return opening;
    });
}

std::unique_ptr<OpenedScene> SceneLoader::take() {
    if (!isOpening() || opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return nullptr;
    std::unique_ptr<OpenedScene> opened = opening_.get();
    before_ = std::exchange(shown_, std::move(asked_));
    current_ = shown_->name;
    options_.device = shown_->options.device;
    remember(*shown_);
    return opened;
}

void SceneLoader::askAgain(const ReloadRequest& reload, float aspect) {
    Request request = *shown_;
    putBack();
    request.reload = reload;
    begin(std::move(request), aspect);
}

void SceneLoader::putBack() {
    shown_ = before_;
    current_ = shown_->name;
    options_.device = shown_->options.device;
}

} // namespace sinew::viewer
