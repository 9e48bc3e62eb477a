// sinew-viewer: shows a scene in a window, or draws it to files.
#include "app/guard.hpp"
#include "app/thread_advice.hpp"
#include "viewer/headless.hpp"
#include "viewer/interactive.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

using namespace sinew;

// One heap for all threads. Scenes are prepared in threads of their own; memory that such a thread frees
// would stay in its own heap, unused by the next one: 456 MB after six changes of scene. Drawing allocates
// too little for contention.
void shareHeap() {
#ifdef __GLIBC__
    mallopt(M_ARENA_MAX, 1);
#endif
}

int view(int argc, char** argv) {
    const std::optional<viewer::Options> options = viewer::parseOptions(argc, argv);
    if (!options) return app::done;
    app::catchSignals();
    static std::atomic<std::size_t> messages = 0;
    app::watchMessages(&messages);
    const int code = options->isHeadless ? viewer::runHeadless(*options, messages)
                                         : viewer::runInteractive(*options, messages);
    if (messages > 0) throw app::Failure(app::internalFault, app::textOfMessages(messages));
    return code == app::interrupted ? app::reportInterruption() : code;
}

} // namespace

int main(int argc, char** argv) {
    shareHeap();
    sinew::app::prepareThreadAdvice();
    return sinew::app::guarded([&] { return view(argc, argv); });
}
