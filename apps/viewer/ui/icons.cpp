// Every icon is drawn in a square of 24 by 24 units, y down.
#include "viewer/ui/icons.hpp"

#include <initializer_list>
#include <numbers>

namespace sinew::viewer {

namespace {

constexpr float units = 24, pi = std::numbers::pi_v<float>;

class Pen {
public:
    Pen(ImDrawList& list, const ImVec2& from, float size, ImU32 color)
        : list_(list), from_(from), unit_(size / units), color_(color) {}

    /// Fills a convex polygon, its corners clockwise.
    void fill(std::initializer_list<ImVec2> corners) {
        for (const ImVec2& corner : corners) list_.PathLineTo(at(corner));
        list_.PathFillConvex(color_);
    }
    void disc(const ImVec2& center, float radius) {
        list_.AddCircleFilled(at(center), radius * unit_, color_);
    }
    void line(const ImVec2& from, const ImVec2& to, float width) {
        list_.PathLineTo(at(from));
        list_.PathLineTo(at(to));
        list_.PathStroke(color_, 0, width * unit_);
    }
    /// A line with a round end at `to`.
    void finger(const ImVec2& from, const ImVec2& to, float width) {
        line(from, to, width);
        disc(to, width / 2);
    }
    /// Clockwise, from angles measured from the x axis.
    void arc(const ImVec2& center, float radius, float from, float to, float width) {
        list_.PathArcTo(at(center), radius * unit_, from, to, segments);
        list_.PathStroke(color_, 0, width * unit_);
    }
    void sector(const ImVec2& center, float radius, float from, float to) {
        list_.PathArcTo(at(center), radius * unit_, from, to, segments);
        list_.PathFillConvex(color_);
    }
    void curve(std::initializer_list<ImVec2> points, float width) {
        const ImVec2* point = points.begin();
        list_.PathLineTo(at(*point++));
        for (; point + 2 < points.end(); point += 3)
            list_.PathBezierCubicCurveTo(at(point[0]), at(point[1]), at(point[2]), segments);
        list_.PathStroke(color_, 0, width * unit_);
    }

private:
    static constexpr int segments = 20;
    ImVec2 at(const ImVec2& place) const { return {from_.x + unit_ * place.x, from_.y + unit_ * place.y}; }
    ImDrawList& list_;
    ImVec2 from_;
    float unit_;
    ImU32 color_;
};

void hand(Pen& pen) {
    constexpr float width = 2.6f;
    pen.finger({8, 13}, {8, 6.5f}, width);
    pen.finger({11.3f, 13}, {11.3f, 4}, width);
    pen.finger({14.6f, 13}, {14.6f, 4.6f}, width);
    pen.finger({17.7f, 13}, {17.7f, 7.5f}, width);
    pen.finger({8.5f, 18}, {4, 13}, width);
    pen.fill({{6.7f, 12}, {19, 12}, {19, 16.5f}, {16.5f, 21.5f}, {10, 21.5f}, {6.7f, 17.5f}});
}

void scalpel(Pen& pen) {
    pen.fill({{19.5f, 2}, {22, 4.5f}, {14, 12.5f}, {11.5f, 10}});
    pen.fill({{10.5f, 11}, {13, 13.5f}, {8.5f, 18}, {2.5f, 21.5f}, {4.5f, 17}});
}

// A sphere that dents a surface.
void sphere(Pen& pen) {
    pen.disc({12, 8}, 5);
    pen.curve({{2, 13}, {6, 13}, {6.5f, 19}, {12, 19}, {17.5f, 19}, {18, 13}, {22, 13}}, 2);
}

void thumbtack(Pen& pen) {
    pen.fill({{7, 2.5f}, {17, 2.5f}, {17, 5}, {7, 5}});
    pen.fill({{9.2f, 5}, {14.8f, 5}, {15.8f, 11}, {8.2f, 11}});
    pen.fill({{5.5f, 11}, {18.5f, 11}, {18.5f, 13.5f}, {5.5f, 13.5f}});
    pen.line({12, 13.5f}, {12, 22}, 1.8f);
}

// A ball behind a plane, and the outline of what the plane cuts away.
void halfBall(Pen& pen) {
    pen.sector({12, 12}, 8, pi / 2, 3 * pi / 2);
    pen.arc({12, 12}, 7.2f, -pi / 2, pi / 2, 1.5f);
    pen.line({12, 1.5f}, {12, 22.5f}, 1.8f);
}

void arrowBack(Pen& pen) {
    pen.arc({12.5f, 13}, 7, pi, 2.6f * pi, 2.2f);
    pen.fill({{1.5f, 11.5f}, {9.5f, 11.5f}, {5.5f, 17.5f}});
}

void arrowOn(Pen& pen) {
    pen.arc({11.5f, 13}, 7, 0.4f * pi, 2 * pi, 2.2f);
    pen.fill({{14.5f, 11.5f}, {22.5f, 11.5f}, {18.5f, 17.5f}});
}

// "To the beginning" of players of films.
void toTheStart(Pen& pen) {
    pen.fill({{4.5f, 5}, {7, 5}, {7, 19}, {4.5f, 19}});
    pen.fill({{19.5f, 5}, {19.5f, 19}, {8, 12}});
}

} // namespace

void drawIcon(ImDrawList& list, Icon icon, const ImVec2& from, float size, ImU32 color) {
    Pen pen(list, from, size, color);
    switch (icon) {
    case Icon::none:
        return;
    case Icon::grab:
        return hand(pen);
    case Icon::cut:
        return scalpel(pen);
    case Icon::poke:
        return sphere(pen);
    case Icon::pin:
        return thumbtack(pen);
    case Icon::inside:
        return halfBall(pen);
    case Icon::undo:
        return arrowBack(pen);
    case Icon::redo:
        return arrowOn(pen);
    case Icon::reset:
        return toTheStart(pen);
    }
}

} // namespace sinew::viewer
