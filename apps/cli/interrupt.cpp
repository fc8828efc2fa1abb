#include "interrupt.h"

#include "petzval/files.h"

#include <csignal>
#include <initializer_list>

namespace petzval::cli {
namespace {

volatile std::sig_atomic_t g_signal = 0;

void remember(int signal) {
    if (g_signal != 0) {
        remove_unfinished_outputs();
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
    g_signal = signal;
}

}  // namespace

void watch_for_interrupts() {
    struct sigaction action = {};
    action.sa_handler = remember;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM}) {
        struct sigaction before = {};
        sigaction(signal, nullptr, &before);
        // A shell that starts us in the background may have asked for SIGINT to be ignored.
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

int interrupted_by() { return g_signal; }

}  // namespace petzval::cli
