// The module's entry: a window of DPF's with the main view in it.
#include <Application.hpp>
#include <Window.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>

#include "window/load_window.h"
#include "window/view/surface.h"

namespace jawari::host::window {

namespace {

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

unsigned pixels(float units, double scale) {
    return static_cast<unsigned>(std::lround(static_cast<double>(units) * scale));
}

class DglWindow : public Window {
  public:
    DglWindow(const WindowRequest& request, Performance& performance, std::unique_ptr<X11Display> display)
        : performance_(performance),
          display_(std::move(display)),
          app_(false),
          view_(performance),
          scale_(request.scale > 0 ? request.scale : 1) {
        WindowSize size = request.size;
        if (size == WindowSize{}) size = {pixels(usual_width, scale_), pixels(usual_height, scale_)};
        // 0 as the scale: DPF asks the system.
        window_ = std::make_unique<DGL_NAMESPACE::Window>(app_, request.parent, size.width, size.height,
                                                          request.scale, true);
        if (!(request.scale > 0)) {
            scale_ = window_->getScaleFactor();
            if (request.size == WindowSize{})
                size = {pixels(usual_width, scale_), pixels(usual_height, scale_)};
        }
        if (request.parent == 0) {
            window_->setGeometryConstraints(pixels(smallest_width, scale_), pixels(smallest_height, scale_));
            window_->setTitle(request.title.c_str());
        }
        if (window_->getWidth() != size.width || window_->getHeight() != size.height)
            window_->setSize(size.width, size.height);
        parent_ = request.parent;
        {
            const DGL_NAMESPACE::Window::ScopedGraphicsContext context(*window_);
            surface_ = std::make_unique<Surface>(*window_, view_, scale_,
                                                 [this](const KeyEventFacts& facts) { give_key(facts); });
        }
    }

    ~DglWindow() override {
        performance_.link().set_open(false);
        {
            const DGL_NAMESPACE::Window::ScopedGraphicsContext context(*window_);
            view_.forget_images();
            surface_.reset();
        }
        if (parent_ == 0) window_->close();
        window_.reset();
    }
    DglWindow(const DglWindow&) = delete;
    DglWindow& operator=(const DglWindow&) = delete;
    DglWindow(DglWindow&&) = delete;
    DglWindow& operator=(DglWindow&&) = delete;

    void idle() override {
        if (shown_) surface_->idle(now_s());
        app_.idle();
    }

    void show() override {
        shown_ = true;
        performance_.link().set_open(true);
        if (parent_ == 0) window_->show();
    }

    void hide() override {
        shown_ = false;
        performance_.link().set_open(false);
        if (parent_ != 0) return;
        window_->hide();
        app_.idle();  // or X11 hears of it with the next idle(), which may never come
    }

    /// DPF asks nobody in a program that is not its own: it hides the window.
    [[nodiscard]] bool is_closed() const override { return parent_ == 0 && shown_ && !window_->isVisible(); }

    [[nodiscard]] WindowSize size() const override { return {window_->getWidth(), window_->getHeight()}; }
    void set_size(const WindowSize& size) override { window_->setSize(size.width, size.height); }
    [[nodiscard]] WindowSize nearest(const WindowSize& size) const override {
        return {std::max(size.width, pixels(smallest_width, scale_)),
                std::max(size.height, pixels(smallest_height, scale_))};
    }
    void set_title(const std::string& title) override { window_->setTitle(title.c_str()); }
    [[nodiscard]] std::uintptr_t native() const override { return window_->getNativeWindowHandle(); }
    void stay_above(std::uintptr_t owner) override { display_->stay_above(native(), owner); }
    [[nodiscard]] WindowCounts counts() const override { return surface_->counts(); }

  private:
    void give_key(const KeyEventFacts& facts) {
        if (parent_ != 0) display_->send_key(parent_, facts);
    }

    Performance& performance_;
    std::unique_ptr<X11Display> display_;
    DGL_NAMESPACE::Application app_;
    MainView view_;
    std::unique_ptr<DGL_NAMESPACE::Window> window_;
    std::unique_ptr<Surface> surface_;
    double scale_;
    std::uintptr_t parent_ = 0;
    bool shown_ = false;
};

}  // namespace

}  // namespace jawari::host::window

extern "C" jawari::host::window::Window* jawari_open_window_1(
    const jawari::host::window::WindowRequest& request, jawari::host::window::Performance& performance,
    char* trouble, std::size_t size) {
    using namespace jawari::host::window;  // NOLINT(google-build-using-namespace): the entry stands outside
    std::string why = "out of memory";
    try {
        if (auto display = X11Display::open(why))
            return new DglWindow(request, performance, std::move(display));  // NOLINT: the caller owns it
    } catch (const std::exception& error) {
        why = error.what();
    }
    std::snprintf(trouble, size, "%s", why.c_str());
    return nullptr;
}

extern "C" bool jawari_find_display_1(char* trouble, std::size_t size) {
    std::string why;
    if (jawari::host::window::X11Display::open(why)) return true;
    std::snprintf(trouble, size, "%s", why.c_str());
    return false;
}
