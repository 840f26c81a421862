// widget.cpp - what panels are made of, with Dear ImGui: the only C++ file, and the only one that
// knows it. Events come from our own queue, so that scripts can work on panels as hands do.
#include "viewer/widget.h"

#include "pellucid.h"

#include <imgui.h>

#include <backends/imgui_impl_opengl3.h>

namespace {

// What Dear ImGui knows of each window.
ImGuiContext *contexts[PEL_WALL_MAX];

// Which widgets' drawings go where.
bool drawing_over = false;

ImDrawList *list() {
    return drawing_over ? ImGui::GetBackgroundDrawList() : ImGui::GetWindowDrawList();
}

ImVec2 vec(const double p[2]) {
    return ImVec2(static_cast<float>(p[0]), static_cast<float>(p[1]));
}

void style(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle &style = ImGui::GetStyle();
    style.WindowRounding = 0;
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.WindowBorderSize = 0;
    style.Colors[ImGuiCol_WindowBg].w = 1;
    style.ScaleAllSizes(scale);
}

// The keys that text fields know.
const struct {
    ImGuiKey theirs;
    int ours;
} keys[] = {
    {ImGuiKey_Tab, PEL_KEY_TAB},
    {ImGuiKey_LeftArrow, PEL_KEY_LEFT},
    {ImGuiKey_RightArrow, PEL_KEY_RIGHT},
    {ImGuiKey_UpArrow, PEL_KEY_UP},
    {ImGuiKey_DownArrow, PEL_KEY_DOWN},
    {ImGuiKey_PageUp, PEL_KEY_PAGE_UP},
    {ImGuiKey_PageDown, PEL_KEY_PAGE_DOWN},
    {ImGuiKey_Home, PEL_KEY_HOME},
    {ImGuiKey_End, PEL_KEY_END},
    {ImGuiKey_Delete, PEL_KEY_DELETE},
    {ImGuiKey_Backspace, PEL_KEY_BACKSPACE},
    {ImGuiKey_Enter, PEL_KEY_ENTER},
    {ImGuiKey_Escape, PEL_KEY_ESCAPE},
    {ImGuiKey_Space, ' '},
    {ImGuiKey_A, 'a'},
    {ImGuiKey_C, 'c'},
    {ImGuiKey_V, 'v'},
    {ImGuiKey_X, 'x'},
    {ImGuiKey_Y, 'y'},
    {ImGuiKey_Z, 'z'},
};

// Since 1.89 Dear ImGui is told what happened, and 1.91.5 took away some of the state that was
// written before. What happened between two pictures counts at once, as it always did: a queue
// that keeps a part for the next picture would wait for one that nothing else asks for.
#if IMGUI_VERSION_NUM >= 18900

void prepare_input(ImGuiIO &io) {
    io.ConfigInputTrickleEventQueue = false;
}

void take_pointer(ImGuiIO &io, const pel_event *event) {
    io.AddMousePosEvent(static_cast<float>(event->x), static_cast<float>(event->y));
}

void take_button(ImGuiIO &io, const pel_event *event) {
    io.AddMouseButtonEvent(event->button, event->down);
}

void take_wheel(ImGuiIO &io, const pel_event *event) {
    io.AddMouseWheelEvent(0, static_cast<float>(event->wheel));
}

void take_modifiers(ImGuiIO &io, const pel_event *event) {
    io.AddKeyEvent(ImGuiMod_Shift, event->modifiers & PEL_SHIFT);
    io.AddKeyEvent(ImGuiMod_Ctrl, event->modifiers & PEL_CONTROL);
    io.AddKeyEvent(ImGuiMod_Alt, event->modifiers & PEL_ALT);
}

void take_key(ImGuiIO &io, const pel_event *event) {
    for (const auto &key : keys)
        if (key.ours == event->key)
            io.AddKeyEvent(key.theirs, event->down && io.WantTextInput);
}

#else

void prepare_input(ImGuiIO &io) {
    for (const auto &key : keys)
        io.KeyMap[key.theirs] = key.ours;
}

void take_pointer(ImGuiIO &io, const pel_event *event) {
    io.MousePos = ImVec2(static_cast<float>(event->x), static_cast<float>(event->y));
}

void take_button(ImGuiIO &io, const pel_event *event) {
    io.MouseDown[event->button] = event->down;
}

void take_wheel(ImGuiIO &io, const pel_event *event) {
    io.MouseWheel += static_cast<float>(event->wheel);
}

void take_modifiers(ImGuiIO &io, const pel_event *event) {
    io.KeyShift = event->modifiers & PEL_SHIFT;
    io.KeyCtrl = event->modifiers & PEL_CONTROL;
    io.KeyAlt = event->modifiers & PEL_ALT;
}

void take_key(ImGuiIO &io, const pel_event *event) {
    io.KeysDown[event->key] = event->down && io.WantTextInput;
}

#endif

} // namespace

bool pel_widget_start(int window, double scale) {
    contexts[window] = ImGui::CreateContext();
    ImGui::SetCurrentContext(contexts[window]);
    ImGuiIO &io = ImGui::GetIO();
    // Where windows were is not kept in a file.
    io.IniFilename = nullptr;
    ImFontConfig font;
    font.SizePixels = static_cast<float>(13 * scale);
    io.Fonts->AddFontDefault(&font);
    // Until the pointer is seen it is nowhere.
    io.MousePos = ImVec2(-1e6f, -1e6f);
    style(static_cast<float>(scale));
    prepare_input(io);
    return ImGui_ImplOpenGL3_Init("#version 330 core");
}

void pel_widget_stop(int window) {
    if (!contexts[window])
        return;
    ImGui::SetCurrentContext(contexts[window]);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(contexts[window]);
    contexts[window] = nullptr;
}

bool pel_widget_take_event(const struct pel_event *event) {
    ImGui::SetCurrentContext(contexts[event->window]);
    ImGuiIO &io = ImGui::GetIO();
    switch (event->kind) {
    case PEL_EVENT_POINTER:
        take_pointer(io, event);
        return io.WantCaptureMouse;
    case PEL_EVENT_BUTTON:
        take_pointer(io, event);
        // A modifier that was let go of after its key is told by the next click.
        take_modifiers(io, event);
        // ImGui counts left, right, middle, as we do.
        take_button(io, event);
        return io.WantCaptureMouse;
    case PEL_EVENT_WHEEL:
        if (io.WantCaptureMouse)
            take_wheel(io, event);
        return io.WantCaptureMouse;
    case PEL_EVENT_TEXT:
        io.AddInputCharacter(event->text);
        return io.WantTextInput;
    case PEL_EVENT_KEY:
        take_modifiers(io, event);
        take_key(io, event);
        return io.WantTextInput;
    default:
        return false;
    }
}

void pel_widget_begin(int window, const int window_px[2], double seconds) {
    ImGui::SetCurrentContext(contexts[window]);
    ImGuiIO &io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(window_px[0]), static_cast<float>(window_px[1]));
    io.DeltaTime = seconds > 1e-4 ? static_cast<float>(seconds) : 1e-4f;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    drawing_over = false;
}

void pel_widget_end(void) {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

// ---- Places to put widgets ---------------------------------------------------------------------

void pel_widget_panel_begin(const char *title, double x, double y, double width, double height) {
    ImGui::SetNextWindowPos(ImVec2(static_cast<float>(x), static_cast<float>(y)));
    ImGui::SetNextWindowSize(ImVec2(static_cast<float>(width), static_cast<float>(height)));
    ImGui::Begin(title, nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoTitleBar |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.62f);
}

void pel_widget_panel_end(void) {
    ImGui::PopItemWidth();
    ImGui::End();
}

void pel_widget_dialog_begin(const char *title, double width, double height, bool *open) {
    ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImVec2 size(static_cast<float>(width), static_cast<float>(height));
    if (size.x > screen.x)
        size.x = screen.x;
    if (size.y > screen.y)
        size.y = screen.y;
    ImGui::SetNextWindowSize(size);
    ImGui::SetNextWindowPos(ImVec2((screen.x - size.x) / 2, (screen.y - size.y) / 2));
    ImGui::Begin(title, open,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings);
}

void pel_widget_dialog_end(void) {
    ImGui::End();
}

bool pel_widget_section(const char *title, bool open_at_first) {
    return ImGui::CollapsingHeader(title, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void pel_widget_push(int number) {
    ImGui::PushID(number);
}

void pel_widget_pop(void) {
    ImGui::PopID();
}

void pel_widget_same_line(void) {
    ImGui::SameLine();
}

void pel_widget_gap(void) {
    ImGui::Spacing();
}

// ---- Widgets -----------------------------------------------------------------------------------

void pel_widget_text(const char *text) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
}

void pel_widget_quiet_text(const char *text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    pel_widget_text(text);
    ImGui::PopStyleColor();
}

void pel_widget_row(const char *left, const char *right, double indent) {
    ImGui::TextUnformatted(left);
    ImGui::SameLine(static_cast<float>(indent));
    ImGui::TextUnformatted(right);
}

void pel_widget_hint(const char *text) {
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", text);
}

bool pel_widget_button(const char *label) {
    return ImGui::Button(label);
}

bool pel_widget_button_if(bool enabled, const char *label) {
    ImGui::BeginDisabled(!enabled);
    bool pressed = ImGui::Button(label);
    ImGui::EndDisabled();
    return pressed;
}

bool pel_widget_check(const char *label, bool *value) {
    return ImGui::Checkbox(label, value);
}

bool pel_widget_choose(const char *label, const char *const *names, int *index) {
    bool changed = false;
    if (!ImGui::BeginCombo(label, *index < 0 ? "choose" : names[*index],
                           ImGuiComboFlags_HeightLarge))
        return false;
    for (int i = 0; names[i]; i++) {
        if (ImGui::Selectable(names[i], i == *index)) {
            *index = i;
            changed = true;
        }
        if (i == *index)
            ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
    return changed;
}

bool pel_widget_select(const char *label, bool selected, double width) {
    return ImGui::Selectable(label, selected, 0, ImVec2(static_cast<float>(width), 0));
}

bool pel_widget_edit(const char *label, char *text, int bytes) {
    return ImGui::InputText(label, text, static_cast<size_t>(bytes));
}

bool pel_widget_colour(const char *label, double rgb[3]) {
    float values[3];
    for (int i = 0; i < 3; i++)
        values[i] = static_cast<float>(rgb[i]);
    if (!ImGui::ColorEdit3(label, values, ImGuiColorEditFlags_Float))
        return false;
    for (int i = 0; i < 3; i++)
        rgb[i] = static_cast<double>(values[i]);
    return true;
}

bool pel_widget_slide(const char *label, double *value, double low, double high,
                      const char *format) {
    return ImGui::SliderScalar(label, ImGuiDataType_Double, value, &low, &high, format);
}

bool pel_widget_slide_log(const char *label, double *value, double low, double high,
                          const char *format) {
    return ImGui::SliderScalar(label, ImGuiDataType_Double, value, &low, &high, format,
                               ImGuiSliderFlags_Logarithmic);
}

bool pel_widget_slide_int(const char *label, int *value, int low, int high) {
    return ImGui::SliderInt(label, value, low, high);
}

bool pel_widget_drag3(const char *label, double value[3], double speed, const char *format) {
    return ImGui::DragScalarN(label, ImGuiDataType_Double, value, 3, static_cast<float>(speed),
                              nullptr, nullptr, format);
}

void pel_widget_progress(double finished, const char *label) {
    ImGui::ProgressBar(static_cast<float>(finished), ImVec2(-1, 0), label);
}

bool pel_widget_settled(void) {
    return ImGui::IsItemDeactivatedAfterEdit();
}

// ---- Drawing -----------------------------------------------------------------------------------

struct pel_widget_canvas pel_widget_area(const char *name, double height) {
    struct pel_widget_canvas canvas = {};
    ImVec2 at = ImGui::GetCursorScreenPos();
    ImVec2 size(ImGui::GetContentRegionAvail().x, static_cast<float>(height));
    canvas.x = static_cast<double>(at.x);
    canvas.y = static_cast<double>(at.y);
    canvas.width = static_cast<double>(size.x);
    canvas.height = static_cast<double>(size.y);
    ImGui::InvisibleButton(name, size);
    const ImGuiIO &io = ImGui::GetIO();
    canvas.hovered = ImGui::IsItemHovered();
    canvas.held = ImGui::IsItemActive();
    canvas.pressed = ImGui::IsItemActivated();
    canvas.released = ImGui::IsItemDeactivated();
    canvas.second = canvas.hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Right);
    canvas.twice = canvas.hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    canvas.pointer[0] = (static_cast<double>(io.MousePos.x) - canvas.x) / canvas.width;
    canvas.pointer[1] = 1 - (static_cast<double>(io.MousePos.y) - canvas.y) / canvas.height;
    return canvas;
}

void pel_widget_draw_over(bool over) {
    drawing_over = over;
}

void pel_widget_line(const double from[2], const double to[2], uint32_t colour, double width) {
    list()->AddLine(vec(from), vec(to), colour, static_cast<float>(width));
}

void pel_widget_box(const double low[2], const double high[2], uint32_t colour, bool filled) {
    if (filled)
        list()->AddRectFilled(vec(low), vec(high), colour);
    else
        list()->AddRect(vec(low), vec(high), colour);
}

void pel_widget_disc(const double centre[2], double radius, uint32_t colour, bool filled) {
    if (filled)
        list()->AddCircleFilled(vec(centre), static_cast<float>(radius), colour);
    else
        list()->AddCircle(vec(centre), static_cast<float>(radius), colour, 0, 1.5f);
}

void pel_widget_write(const double at[2], uint32_t colour, const char *text) {
    list()->AddText(vec(at), colour, text);
}

double pel_widget_letter_height(void) {
    return static_cast<double>(ImGui::GetFontSize());
}

double pel_widget_text_width(const char *text) {
    return static_cast<double>(ImGui::CalcTextSize(text).x);
}
