// Input from keys, pointer and panels for the scene on show.
#include "viewer/panels/knob_keys.hpp"
#include "viewer/show.hpp"

#include <utility>

namespace sinew::viewer {

namespace {

constexpr std::uint32_t picturesOfAFocus = 5; // until Dear ImGui passes keys to a new text field

} // namespace

// Handles requests of the panels. After a button for a pin or a view, the next press gives the point.
void Show::grant(const Wishes& wishes, Input& input) {
    for (const Action action : wishes.actions)
        if (action == Action::pin && !replay_)
            tools_.armPin();
        else if (action == Action::frameBody || action == Action::center)
            armed_ = action == Action::center ? Look::At::point : Look::At::body;
        else
            input.actions.push_back(action);
    if (wishes.previews) library_.previews().want(*wishes.previews);
    if (wishes.scene && mayOpen()) library_.open(*wishes.scene, pictureAspect());
    if (wishes.file && mayOpen()) library_.openFile(*wishes.file, pictureAspect());
    if (wishes.device && mayOpen()) changeDevice(*wishes.device);
    if (wishes.sectionOffset && screen_.layers().section) {
        screen_.layers().section->offset = *wishes.sectionOffset;
        input.needsRedraw = true;
    }
    if (wishes.beside) screen_.beside() = shapeOf(*wishes.beside);
    if (wishes.knobs && !replay_) turnKnobs(*wishes.knobs); // the log controls the scene
}

void Show::turnKnobs(const Knobs& knobs) {
    if (knobs.gravity != knobs_.gravity) tools_.pull(stage_, knobs.gravity);
    controller_.playback.setPace(double{knobs.pace});
    if (knobs.bladeDepth != tools_.depth()) tools_.setDepth(knobs.bladeDepth);
    knobs_.gravity = knobs.gravity;
    knobs_.pace = knobs.pace;
    knobs_.substeps = knobs.substeps;
    knobs_.solver = knobs.solver;
    turnMaterial(knobs);
}

// Requests a material in the background.
void Show::turnMaterial(const Knobs& knobs) {
    const sim::Material before = materialOf(knobs_, sceneFacts_.fromFile);
    knobs_.stiffness = knobs.stiffness;
    knobs_.damping = knobs.damping;
    knobs_.friction = knobs.friction;
    knobs_.bodies = knobs.bodies;
    knobs_.body = knobs.body;
    const sim::Material material = materialOf(knobs_, sceneFacts_.fromFile);
    if (material != before) stage_.turn(material);
}

// Polls the material. On an error everything stays; a change of passes needs another simulation.
void Show::takeTurn() {
    try {
        if (stage_.takeTurn(controller_.playback.isPaused()) == Stage::Turn::refused) isRefused_ = true;
    } catch (const std::exception& error) {
        screen_.warn(error.what());
    }
}

// Whether a scene may be opened: one at a time.
bool Show::mayOpen() {
    if (library_.isOpening()) screen_.tell("another scene is still being opened");
    return !library_.isOpening();
}

void Show::handle(const Input& asked) {
    Input input = asked;
    const auto isPress = [](const Input::Press& press) {
        return press.isDown && press.action == Action::grab;
    };
    if (armed_ && std::erase_if(input.presses, isPress) > 0) lookAt(*std::exchange(armed_, std::nullopt));
    if (!input.files.empty() && mayOpen()) library_.openFile(input.files.front(), pictureAspect());
    for (const Action action : input.actions) {
        if (action == Action::drop && screen_.panels().isHelpShown())
            screen_.panels().closeHelp();
        else if (!isOfReplay(action) && !controller_.act(action) && !tools_.act(action))
            handle(action);
    }
    if (!replay_) tools_.handle(input, controller_);
    if (const std::string note = tools_.takeNote(); !note.empty()) screen_.tell(note);
    screen_.feed(input.panels);
    status_.setTool(tools_.name());
    if (std::optional<Section>& section = screen_.layers().section; section && input.slide != 0)
        section = moved(*section, input.slide, opening_.light.bounds);
    const float notches = input.notches + (tools_.isPokeOn() || tools_.isBladeOn() ? 0 : input.growth);
    if (notches != 0 && !replay_) controller_.wheel(notches, input.pointer);
}

void Show::handle(Action action) {
    switch (action) {
    case Action::frame:
        wantsProbe_ = true;
        break;
    case Action::frameBody:
        lookAt(Look::At::body);
        break;
    case Action::center:
        lookAt(Look::At::point);
        break;
    case Action::section:
    case Action::turnSection:
    case Action::faceSection:
        changeSection(action);
        break;
    case Action::beside:
        toggleBeside();
        break;
    case Action::screenshot:
        wantsScreenshot_ = true;
        break;
    case Action::fullScreen:
        screen_.window().toggleFullScreen();
        break;
    case Action::vsync:
        screen_.toggleVsync();
        break;
    case Action::largerTexts:
        screen_.changeScale(1);
        break;
    case Action::smallerTexts:
        screen_.changeScale(-1);
        break;
    case Action::previousScene:
        if (mayOpen()) library_.openNext(-1, pictureAspect());
        break;
    case Action::nextScene:
        if (mayOpen()) library_.openNext(1, pictureAspect());
        break;
    case Action::open:
        screen_.panels().askForFile();
        panelsDue_ = picturesOfAFocus;
        break;
    case Action::inspect:
        inspector_.toggle();
        break;
    case Action::saveInput:
        saveInput();
        break;
    case Action::saveState:
        saveState();
        break;
    case Action::times:
        screen_.tell(screen_.timing().times().summary());
        screen_.timing().printTable();
        break;
    case Action::record:
        toggleRecording();
        break;
    case Action::panels:
        screen_.panels().toggle();
        break;
    case Action::help:
        screen_.panels().toggleHelp();
        break;
    case Action::quit:
        screen_.window().close();
        break;
    default:
        if (const auto turned = turnedBy(action, shownKnobs())) {
            turnKnobs(turned->knobs);
            screen_.tell(turned->said);
        } else
            switchLayer(action);
    }
}

void Show::switchLayer(Action action) {
    Layers& layers = screen_.layers();
    switch (action) {
    case Action::skinLook:
        layers.skin = next(layers.skin);
        break;
    case Action::wires:
        toggleWires();
        break;
    case Action::balls:
        layers.hasBalls = !layers.hasBalls;
        break;
    case Action::links:
        layers.hasLinks = !layers.hasLinks;
        break;
    case Action::contacts:
        layers.hasContacts = !layers.hasContacts;
        break;
    case Action::cells:
        layers.hasCells = !layers.hasCells;
        break;
    case Action::colorMap:
        layers.map = next(layers.map);
        mapRange_ = {};
        break;
    default:
        break; // drags, the wheel, and actions of the controller
    }
}

// Requests a camera move to the point under the pointer.
void Show::lookAt(Look::At at) {
    wantsLook_ = Look{at, rayThrough(controller_.camera, pointer_)};
}

// Changes the section; without one, turning starts with the first axis.
void Show::changeSection(Action action) {
    std::optional<Section>& section = screen_.layers().section;
    const Camera& camera = controller_.camera;
    if (action == Action::section)
        section = section ? std::nullopt : std::optional(sectionAcross(camera));
    else if (action == Action::faceSection)
        section = sectionFacing(camera);
    else
        section = section ? turned(*section, camera.target) : sectionAcross(camera);
}

void Show::toggleWires() {
    if (!drawsEdges(device_)) return screen_.warn("this device cannot draw the edges of triangles");
    screen_.layers().hasWires = !screen_.layers().hasWires;
}

} // namespace sinew::viewer
