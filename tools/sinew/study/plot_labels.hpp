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

    /// Places a label beside one of the points of `front`, inside the box, far from other lines and labels.
    Label place(const std::string& text, const std::vector<Spot>& front, std::size_t slot);

private:
    struct Obstacle {
        Spot spot;
        std::size_t slot;
    };
    double roomAround(const Box& text, std::size_t slot) const;

    Box box_;
    std::vector<Obstacle> obstacles_;
    std::vector<Box> labels_;
};

} // namespace sinew::tools::study
