// How long pictures took: what each of them cost, gathered while they are drawn, and the table that --timing
// and a key make of it.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace sinew::viewer {

/// The newest `most` values of each kind. One thread.
class FrameTimes {
public:
    static constexpr std::size_t most = 1u << 17; ///< half an hour at 60 pictures a second
    static constexpr double tooLong = 100;        ///< [ms]

    enum class Kind {
        frame,          ///< from one picture's submission to the next, while pictures follow each other [ms]
        frameOfCut,     ///< likewise, of those in which something is cut
        thread,         ///< processor time of the thread that looks at keys, between two looks [ms]
        step,           ///< on the device [ms]
        drawing,        ///< likewise: skins, maps, picture
        panels,         ///< likewise
        inputToPicture, ///< from the earliest that an event can have come until its picture is finished [ms]
        picturesBefore, ///< how many pictures were finished after the event was taken and do not hold it
        count
    };

    void add(Kind kind, double value);
    /// A picture that came `ms` after the last.
    void addFrame(double ms, bool isOfCut);
    /// By the thread that looks at keys, which waits for them meanwhile.
    void addPipelines(std::size_t count) { pipelines_ += count; }
    void clear();

    std::size_t count(Kind kind) const { return of(kind).total; }
    /// The smallest value that at least `share` of the newest are not above; 0 of none.
    double quantile(Kind kind, double share) const;
    std::size_t slowFrames() const { return slow_; }           ///< longer than tooLong
    std::size_t slowFramesOfCut() const { return slowOfCut_; } ///< those of them in which something was cut
    double framesPerSecond() const;

    /// Lines: pictures a second, a line for each kind of which there is any, and what took too long.
    std::string table() const;
    /// "24.1 pictures a second, 41 ms each (p50), 120 ms at most".
    std::string summary() const;

private:
    struct Values {
        std::vector<float> newest; // a ring of `most`
        std::size_t total = 0;     // that ever came
        double largest = 0, sum = 0;
    };
    const Values& of(Kind kind) const { return values_[static_cast<std::size_t>(kind)]; }
    std::string line(Kind kind) const;

    std::array<Values, static_cast<std::size_t>(Kind::count)> values_;
    std::size_t slow_ = 0, slowOfCut_ = 0, pipelines_ = 0;
};

} // namespace sinew::viewer
