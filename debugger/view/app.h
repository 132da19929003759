// The window's content: a session, what is shown of it, and the panels. Draws with ImGui into whatever host made the context.
#pragma once

#include <algorithm>
#include <string>

#include "debugger/view/measurements.h"
#include "debugger/view/preferences.h"
#include "debugger/view/session.h"
#include "debugger/view/theme.h"
#include "debugger/view/thumbnails.h"
#include "recordings/gallery.h"

namespace gjkdbg {

/// A rectangle of the window, in pixels.
struct Area {
  float x = 0, y = 0, width = 0, height = 0;
};

class App {
 public:
  App(Gallery gallery, float scale);

  Session session;
  Theme theme;
  Preferences preferences;   ///< what a restart remembers
  ViewSettings settings;
  Camera world_camera, difference_camera;
  enum class LeftTab { gallery, scene } left_tab = LeftTab::gallery;
  bool show_keys = false;
  bool lecture = false;       ///< big sentence, no side panels
  bool show_lab = false;      ///< charts and atlas in place of the scene
  enum class LabTab { chart, atlas } lab_tab = LabTab::chart;
  enum class ChartView { error, gap, iterations, price, motion } chart_view = ChartView::error;
  Measurements measured;
  std::string measure_requested;  ///< "chart" or "atlas": the host measures, opens the result and clears this
  bool measuring = false;         ///< the host is at it
  bool quit = false;          ///< the person wants to leave
  std::string message;        ///< the last error, shown until the next success
  std::string notice;         ///< the last thing done ("copied"), shown for a while
  std::string running;        ///< what is being done beside the window, for as long as it is
  std::string save_requested; ///< a file name the person gave; the host writes it, puts what went wrong into `message`, and clears this
  std::string stop_when_text; ///< the condition as typed
  std::string stop_when_error;
  int place_digits = 4;          ///< of positions in the scene's panel
  char gallery_search[64] = {};  ///< what is looked for in the gallery
  std::string gallery_shows;      ///< the scene the gallery has gone to

  /// Opens a file or a gallery scene; what is wrong is shown in the window.
  void open(const std::filesystem::path& file);
  /// Files dropped on the window. The first is what a dialog asks for, where one does, or is opened; with the next frame.
  void drop(const std::vector<std::filesystem::path>& files) { dropped_ = files; }
  /// The same as `open`: a scene, a recording, a chart.json or an atlas.json; throws Error.
  void open_or_throw(const std::filesystem::path& file);
  void open_gallery(const std::string& name);
  /// A solver's run, at its first finding. Where the same scene is open, cameras, breakpoints and what stands beside it stay; whoever looks at another step
  /// of the run before stays there.
  void show_run(Recording run);
  /// The gallery's next scene (1) or the one before (-1), through all lessons; of a scene that is not there its first or last.
  void open_beside(int step);
  /// Another recording beside this one: told by its method where it is of the same scene. Throws Error.
  void compare_or_throw(const std::filesystem::path& file);
  const Gallery& gallery() const { return gallery_; }
  Thumbnails& thumbnails() { return thumbnails_; }

  /// An edit of the scene: what is wrong with it, or that another program's run has made way, is said in the window.
  void edit(const SceneFile& next);

  /// One frame: keys, panels, views. Call between ImGui::NewFrame and ImGui::Render.
  void frame();
  /// Only the two views with a caption: what `render` writes.
  void picture_frame();
  /// Whether the next frame would differ without any input: something plays, or a notice fades.
  bool moving() const { return session.playing || notice_left_ > 0 || thumbnails_.busy(); }
  void fit_views();
  /// Where an edit has taken a body out of the views, or left it as a speck in them.
  void fit_what_has_left();
  /// For as long as it takes to read it.
  void note(std::string text, bool bad = false) { notice = std::move(text), notice_is_bad_ = bad, notice_left_ = std::max(3.f, 0.08f * static_cast<float>(notice.size())); }
  void drop_note() { notice_left_ = 0; }

  enum class Asking { nothing, open, save, compare, go_to };
  void ask(Asking what) { asking_ = what; }
  /// A bar above the views, beside which the rest of the window can be used.
  void open_find_bar();
  bool finding() const { return find_.open; }
  /// Whether the scene's description stands on the left.
  bool shows_scene_panel() const { return wide_ && left_tab == LeftTab::scene; }

 private:
  void keys();
  void step_keys(bool shift, bool control);
  void control_keys(bool shift);
  void view_keys();
  void window_keys();
  void top_bar(const Area& area);
  void title_and_chips(const Area& area);
  void left_panel(const Area& area);
  void icon_rail(const Area& area);
  void lecture_panel(const Area& area);
  void lecture_place(const std::string& place);
  float lecture_scale(float window_height) const;
  void panels(const Area& window);
  bool is_low(const Area& window) const;
  float scrubber_height() const;
  void small_panels(const Area& window, float top);
  void splitter(const char* name, const Area& area, bool vertical, float& value, float low, float high, float sign);
  void banner(const Area& above);
  void key_sheet();
  void dialogs();
  void file_dialog();
  void file_list();
  void file_entered();
  void file_dropped(bool dialog);
  bool file_taken(const std::string& name);
  void file_saved();
  void find_bar();
  void find_keys();
  bool find_takes_letters();
  void find_while_typing();
  void find_next(bool backwards);
  void forget_found();
  void go_to_dialog();

  Gallery gallery_;
  Thumbnails thumbnails_;
  int fitted_ = 0;
  Area views_;  ///< where the views were drawn
  std::optional<LeftTab> rail_opens_;  ///< with the next frame
  bool wide_ = true, rail_open_ = false;  ///< whether the left panel has room; where it has none, whether what the rail opens is open
  Asking asking_ = Asking::nothing, asked_ = Asking::nothing;
  struct FindBar {
    bool open = false, wants_focus = false;
    bool in_hand = false;              ///< nothing else was clicked on since: what is typed is for the field
    bool to_its_end = false;           ///< typing goes on behind what is there
    char text[256] = {};
    std::size_t from = 0;              ///< where the text that is being typed is looked for from
    std::optional<std::size_t> found;  ///< by the last search
    int opened = 0;                    ///< what it was found in
    std::string error;
  } find_;
  char file_buffer_[1024] = {};
  std::string file_error_;                ///< what became of the name in the dialog
  std::string replacing_;                 ///< a file that is there; saved over when it is asked for once more
  std::vector<std::filesystem::path> dropped_;
  bool saving_ = false;                   ///< the host has been asked to
  bool name_wanted_ = false;              ///< with the next frame the name can be typed on
  std::optional<std::string> listed_for_; ///< the name whose possible ends are listed
  std::vector<std::string> listed_;
  int go_to_ = 0;
  float notice_left_ = 0;  ///< seconds
  bool notice_is_bad_ = false;
  bool list_open_ = false;  ///< to choose from, at the end of the last frame
};

// --- Panels, each a file -------------------------------------------------------------------------------------------

/// To choose from; not a dialog, nor what the rail of a narrow window has opened.
bool list_is_open();
void gallery_panel(App& app);
void scene_panel(App& app);
/// Of the scene panel, all bodies that it shows, each with what can be edited; true when edited.
bool all_bodies(App& app, SceneFile& next, double size);
/// Moving scenes take any number of bodies.
bool add_body(SceneFile& next);
/// Of the scene panel, each with its heading.
void compare_section(App& app);
void stop_section(App& app);
/// The methods that can answer the scene's query on its bodies; `fastest` stands for one of them where there is a choice.
std::vector<int> possible_methods(const SceneFile& file);
void step_panel(App& app, const Area& area);
void timeline_panel(App& app, const Area& area);
void time_axis(App& app);  ///< of a moving scene, above the timeline
void transport(App& app);
void scrubber(App& app);
void event_list(App& app, float width, float height);
void bounds_plot(App& app, float width, float height);
void motion_plot(App& app, float width, float height);
void lab_panel(App& app, const Area& area);
void way_back(App& app);
/// What a name in a picture stands for, with its numbers; empty where it says so itself.
std::string meaning_of(const std::string& label, bool world, const Frame& frame, const Recording& recording);
/// What a heading or a row of the step's panel means; empty where it says so itself.
std::string glossary(std::string_view name);
/// What a method, a query or a setting is that can be chosen.
std::string meaning_of_choice(std::string_view name);
/// A tooltip that says so, when what was drawn last is pointed at.
void tell_meaning(const Theme& theme, const char* name);
/// The two views, side by side or stacked, or the one chosen.
void view_panels(App& app, const Area& area, bool interactive);

// --- Small things all panels share ----------------------------------------------------------------------------------

/// A borderless child window over an area; call ImGui::EndChild after it.
bool begin_area(const char* name, const Area& area, bool scrolls = false);
/// The same, with less of a margin where it is low.
bool begin_panel(const Theme& theme, const char* name, const Area& area, bool scrolls = false);
/// Whether an area is so low that its margin is 10 logical pixels wide.
bool has_small_margin(const Theme& theme, const Area& area);
/// What is left of a panel, scrolled for itself. Like begin_area, to be ended by ImGui::EndChild.
bool begin_list(const char* name);
void section(const Theme& theme, const char* title);
/// A line of text, or as much of it as fits into `room`, and three dots.
std::string shortened(const ImFont* font, const std::string& text, float room);
/// Lines no wider than `room`, in the current font, broken between words only (ImGui breaks after any point, that of a number, too), and of "w = a - b" not
/// within it where it has room; a word that is too wide for a line, an address, is broken anywhere.
std::string broken_into_lines(const std::string& text, float room);
/// So broken.
void wrapped(const std::string& text, Colour colour);
void wrapped(const std::string& text, Colour colour, float room);
/// Of sentences, broken into lines.
void tooltip(const Theme& theme, const std::string& text);
/// Of the last item of a row of buttons, where it is pointed at: below the row, in the window's lower half above it, so that the others stay in sight.
void tip_beside_row(const Theme& theme, const char* text);
/// A label on the left and a number in the monospaced font, right-aligned, below where there is no room beside.
void number_row(const Theme& theme, const char* label, const std::string& value, Colour colour);
/// A click goes to `source`, the step that produced the number. `exact`: with all digits, for the tooltip and a right click, which copies it.
void number_row(App& app, const char* label, const std::string& value, Colour colour, std::optional<std::size_t> source, const std::string& exact = {});
/// Numbers of one section, small ones with fewer digits: with blanks behind them, so that those that end in one column have their points in one column.
/// What has no point, or an exponent, ends without.
std::vector<std::string> at_one_point(const std::vector<double>& values);
/// Numbers as they are shown, with all digits as `exact`.
void number_row(App& app, const char* label, double value, Colour colour, std::optional<std::size_t> source = {});
void number_row(App& app, const char* label, const AnyVector& value, Colour colour, std::optional<std::size_t> source = {}, int digits = 4);
std::string all_digits(double x);
/// Of the two bodies that are looked at their own colours, of the others none.
Colour letter_colour(App& app, int body);
/// One of several buttons of which one is `current`; width 0: as the text needs.
bool tab_button(const Theme& theme, const char* name, bool current, float width = 0);
constexpr float label_width = 96;  ///< of the scene panel's rows, in logical pixels
/// One labelled row of numbers, or where `digits`, if more than usual are wanted, have no room in one, a row each; true when edited.
bool numbers(const Theme& theme, const char* label, double* values, int count, float speed, const double* low = nullptr, int digits = 4);
/// A rounded label.
void chip(const Theme& theme, const std::string& text, Colour colour);
Colour event_colour(const Palette& palette, const Event& event);
/// How tall its tick is on the scrubber, 1 the tallest: kinds are told apart by more than colour.
float event_share(const Event& event);
/// "support", "simplex", …: a word for an event's kind in lists.
const char* short_kind(const Event& event);

/// Whether the bounds leave open more of the distance or depth than four digits: what is given is the most it can be.
bool unproven(const Result& result);
/// The answer in a few words: "overlapping, depth 0.1".
std::string result_text(const Recording& recording);
/// "gjk · signed-volumes · double"; of another implementation's run "your solver"
std::string method_text(const Recording& recording);
/// Where the two runs that are compared part, in the words that stand wherever it is said.
std::string parting_text(const Session& session);
/// Which of two runs that are compared is longer; empty where neither is.
std::string ending_text(const Session& session);
/// Whether two runs come to the same, within 1e-9.
bool answers_agree(const Result& a, const Result& b);
/// The signed distance is at most as much, by EPA's first face, where that says more than the events so far.
std::optional<double> bound_by_first_face(Session& session);
/// "Step 14 of 22 · EPA iteration 1"
std::string place_text(Session& session);
/// Of ASCII letters: for comparisons in either case.
std::string lower_case(std::string text);
/// Where `text` is found, in either case: a condition if it compares something, else a part of the event's name and summary, or where no step has it there
/// of a step's title and sentence (of at most 20,000 steps).
std::optional<std::size_t> find_text(const Session& session, const std::string& text, std::size_t from, bool backwards);

}  // namespace gjkdbg
