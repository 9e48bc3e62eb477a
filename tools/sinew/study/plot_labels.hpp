// Places each curve's name beside the curve with the least overlap.
#pragma once

#include "sinew/study/plot_axes.hpp"

namespace sinew::tools::study {

struct Label {
    double x = 0, y = 0; ///< start of the text's base line
};

class LabelPlacer {
public:
    explicit LabelPlacer(const Box& box) : box_(box) {}

    /// Labels avoid this line.
    void avoid(const std::vector<Spot>& line, std::size_t slot);
    /// Labels do not cover a marker, whosever it is.
    void avoidMark(Spot spot, double radius) { marks_.push_back({spot, radius}); }
    /// Labels do not cover a text that starts at `label`.
    void avoidText(const std::string& text, Label label);

    /// Places a label beside one of the points of `front`, inside the box, far from other lines and labels.
    Label place(const std::string& text, const std::vector<Spot>& front, std::size_t slot);

private:
    struct Obstacle {
        Spot spot;
        std::size_t slot;
    };
    struct Mark {
        Spot spot;
        double radius;
    };
    double roomAround(const Box& text, std::size_t slot) const;

    Box box_;
    std::vector<Obstacle> obstacles_;
    std::vector<Mark> marks_;
    std::vector<Box> labels_;
};

} // namespace sinew::tools::study
