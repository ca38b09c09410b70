#include "devices/connection_watch.h"

#include <utility>

#include "devices/quiet.h"

#ifdef JAWARI_JACK
#include <jack/jack.h>

#include <algorithm>
#include <mutex>
#include <string_view>
#endif

namespace jawari::host {

#ifdef JAWARI_JACK

namespace {

/// Has no ports.
constexpr const char* watcher_name = "jawari-watch";

struct CloseJack {
    void operator()(jack_client_t* jack) const { jack_client_close(jack); }
};

struct FreeNames {
    void operator()(const char** names) const { jack_free(names); }
};

std::string name_of_port(jack_client_t* jack, jack_port_id_t number) {
    const jack_port_t* port = jack_port_by_id(jack, number);
    const char* name = port == nullptr ? nullptr : jack_port_name(port);
    return name == nullptr ? "" : name;
}

}  // namespace

struct ConnectionWatch::Client {
    std::mutex mutex;  ///< of cuts, which JACK's and the control thread use
    std::vector<CutConnection> cuts;
    std::string name;                 ///< how our inputs begin
    std::vector<std::string> inputs;  ///< as last noted
    std::unique_ptr<jack_client_t, CloseJack> jack;

    static void on_connect(jack_port_id_t from, jack_port_id_t to, int connected, void* user) {
        if (connected != 0) return;
        auto& client = *static_cast<Client*>(user);
        CutConnection cut{name_of_port(client.jack.get(), to), name_of_port(client.jack.get(), from)};
        if (cut.input.empty()) return;
        const std::lock_guard lock(client.mutex);
        client.cuts.push_back(std::move(cut));
    }

    /// Without it some versions of JACK end the process with the server.
    static void on_shutdown(void* /*user*/) {}

    [[nodiscard]] std::vector<std::string> inputs_now() const {
        std::vector<std::string> found;
        const std::unique_ptr<const char*, FreeNames> names(
            jack_get_ports(jack.get(), nullptr, JACK_DEFAULT_MIDI_TYPE, JackPortIsInput));
        for (const char** each = names.get(); each != nullptr && *each != nullptr; ++each)
            if (std::string_view(*each).starts_with(name)) found.emplace_back(*each);
        return found;
    }
};

std::unique_ptr<ConnectionWatch> ConnectionWatch::create(const std::string& system, const std::string& name) {
    if (system != "jack") return nullptr;
    const QuietStandardError quiet;
    auto client = std::make_unique<Client>();
    client->name = name;
    jack_client_t* jack = jack_client_open(watcher_name, JackNoStartServer, nullptr);
    if (jack == nullptr) return nullptr;
    client->jack.reset(jack);
    jack_on_shutdown(jack, &Client::on_shutdown, nullptr);
    const bool asked = jack_set_port_connect_callback(jack, &Client::on_connect, client.get()) == 0;
    if (!asked || jack_activate(jack) != 0) return nullptr;
    return std::unique_ptr<ConnectionWatch>(new ConnectionWatch(std::move(client)));
}

void ConnectionWatch::note_inputs() {
    client_->inputs = client_->inputs_now();
}

std::optional<std::string> ConnectionWatch::new_input() const {
    const std::vector<std::string>& before = client_->inputs;
    std::vector<std::string> added = client_->inputs_now();
    std::erase_if(added, [&before](const std::string& name) {
        return std::find(before.begin(), before.end(), name) != before.end();
    });
    if (added.size() != 1) return std::nullopt;
    return added.front();
}

std::vector<CutConnection> ConnectionWatch::take_cuts() {
    const std::lock_guard lock(client_->mutex);
    return std::exchange(client_->cuts, {});
}

#else

struct ConnectionWatch::Client {};

std::unique_ptr<ConnectionWatch> ConnectionWatch::create(const std::string& /*system*/,
                                                         const std::string& /*name*/) {
    return nullptr;
}

void ConnectionWatch::note_inputs() {}

std::optional<std::string> ConnectionWatch::new_input() const {
    return std::nullopt;
}

std::vector<CutConnection> ConnectionWatch::take_cuts() {
    return {};
}

#endif

ConnectionWatch::ConnectionWatch(std::unique_ptr<Client> client) : client_(std::move(client)) {}

ConnectionWatch::~ConnectionWatch() {
    const QuietStandardError quiet;  // closing complains if the server is gone
    client_.reset();
}

}  // namespace jawari::host
