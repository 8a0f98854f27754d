#include "src/viewer/gui.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cmath>

namespace stipple {
namespace {

constexpr float kFontPixels = 13.0f;  // of the built-in font, which is sharp at whole multiples

void set_style(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 6.0f;
  style.FrameRounding = 3.0f;
  style.GrabRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
  style.WindowPadding = {10.0f, 10.0f};
  style.ItemSpacing = {8.0f, 5.0f};
  style.Colors[ImGuiCol_WindowBg] = {0.10f, 0.11f, 0.13f, 0.92f};
  style.Colors[ImGuiCol_Header] = {0.20f, 0.24f, 0.30f, 1.0f};
  style.ScaleAllSizes(scale);
}

}  // namespace

Gui::Gui(Window& window) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // our own settings keep what is worth keeping
  io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
  const float scale = window.text_scale();
  ImFontConfig font;
  font.SizePixels = std::round(kFontPixels * scale);
  io.Fonts->AddFontDefault(&font);
  set_style(scale);
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Gui::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::takes_mouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::takes_keys() const {
  return ImGui::GetIO().WantTextInput;
}

}  // namespace stipple
