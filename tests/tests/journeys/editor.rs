//! An author of rules writes in an editor: Neovim, which others wrote, speaks with `adit lsp` as it speaks with any server.

use std::process::Command;

use adit_tests::{TestSite, adit};
use serde_json::Value;

/// What the editor does is Lua; `client` has been attached to the buffer of the file when it begins.
const BEFORE: &str = r#"
local function wait(what, look)
  if not vim.wait(60000, look, 20) then print("WAITED IN VAIN FOR " .. what); vim.cmd("cq") end
end
local file, program = vim.env.ADIT_FILE, vim.env.ADIT
vim.cmd("edit " .. vim.fn.fnameescape(file))
local client = vim.lsp.start_client({ cmd = { program, "lsp" }, root_dir = vim.fn.getcwd() })
vim.lsp.buf_attach_client(0, client)
wait("the server", function() return vim.lsp.buf_is_attached(0, client) and vim.lsp.get_client_by_id(client).initialized end)
local function place(text, within)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    local at = line:find(text, 1, true)
    if at then
      return { textDocument = vim.lsp.util.make_text_document_params(),
               position = { line = number - 1, character = at - 1 + (within or 0) } }
    end
  end
  print("NO " .. text); vim.cmd("cq")
end
local function ask(method, params)
  local answers = vim.lsp.buf_request_sync(0, method, params, 30000)
  for _, answer in pairs(answers or {}) do return answer end
end
-- editors before 0.8 call it otherwise
local function refusal(answer) return (answer.err or answer.error or {}).message or "" end
local function problems(buffer)
  local found = {}
  for _, one in ipairs(vim.diagnostic.get(buffer)) do
    table.insert(found, { line = one.lnum + 1, column = one.col + 1, message = one.message, severity = one.severity, code = one.code })
  end
  return found
end
local function write(lines) vim.api.nvim_buf_set_lines(0, 0, -1, false, lines) end
local function labels(answer)
  local found = {}
  for _, one in ipairs(answer.result.items or answer.result) do table.insert(found, one.label) end
  return found
end
local said = {}
"#;

const AFTER: &str = r#"
io.stdout:write(vim.json and vim.json.encode(said) or vim.fn.json_encode(said))
vim.lsp.stop_client(client)
vim.cmd("qall!")
"#;

/// Runs an editor on a file of a site, and gives what its script has put into `said`.
fn edit(site: &TestSite, file: &str, script: &str) -> Value {
    let lua = site.path().join("script.lua");
    // an editor that meets a mistake of the script would wait for somebody to press a key
    let all = format!(
        "local well, why = pcall(function()\n{BEFORE}{script}{AFTER}end)\n\
         if not well then io.stderr:write(tostring(why)); vim.cmd(\"cq\") end\n"
    );
    std::fs::write(&lua, all).expect("written");
    let output = Command::new("nvim")
        .args(["--headless", "--clean", "-n", "-c"])
        .arg(format!("luafile {}", lua.display()))
        .env("ADIT", adit())
        .env("ADIT_FILE", site.path().join(file))
        .env("XDG_STATE_HOME", site.path())
        .current_dir(site.path())
        .output()
        .expect("Neovim runs; tests/run installs it");
    let (said, complained) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    std::fs::remove_file(&lua).expect("removed");
    serde_json::from_str(&said).unwrap_or_else(|error| panic!("{error}: {said} {complained}"))
}

/// The paper's example with a rule of the user's over the shipped ones, and a test of it.
fn site() -> TestSite {
    let site = TestSite::example("paper");
    site.write(
        "rules/draught.rhai",
        "// the south is draughty\n\
         fn worse(x) { x * 1.5 }\n\
         rule \"how draughty\" each room in ROOMS where room.y1 < 4.0 then { room.draught = worse(1.0); }\n\
         rule \"draughty doors\"\n    each door in DOORS\n    some room in ROOMS where room.room == door.room1 && room.draught > 1.0\n    then { door.draughty = true; }\n\
         revise \"draughty doors are hard\" each door in DOORS where door.draughty set door.hardness by * 2.0 level 9\n",
    );
    site.write(
        "rules/tests/draught.toml",
        "[given]\nROOMS = [{ room = 1, y1 = 2.0 }]\n[[test]]\nname = \"the south is draughty\"\n[test.conclude]\nROOMS.1 = { draught = 1.5 }\n",
    );
    site
}

#[test]
fn a_mistake_is_marked_while_it_is_typed_and_gone_when_it_is() {
    let site = site();
    let said = edit(
        &site,
        "rules/draught.rhai",
        r#"
local lines = vim.api.nvim_buf_get_lines(0, 0, -1, false)
write({ 'rule "wrong" each room in ROOMS where room.wdith > 1.0 then { room.hardness = 1.0; }' })
wait("the mistake", function() return #problems(0) > 0 end)
said.wrong = problems(0)
write({ 'rule "half' })
wait("half a rule", function() local now = problems(0); return #now > 0 and not now[1].message:find("wdith") end)
said.half = problems(0)
write(lines)
wait("peace", function() for _, one in ipairs(problems(0)) do if one.severity == 1 then return false end end return true end)
said.right = problems(0)
"#,
    );
    let message = said["wrong"][0]["message"].as_str().expect("a message");
    assert!(
        message.contains("wdith") && message.contains("width"),
        "what is wrong, and what is meant: {message}"
    );
    assert_eq!(said["wrong"][0]["line"], 1);
    assert_eq!(said["wrong"][0]["code"], "rule/unknown-property");
    assert_eq!(said["half"][0]["line"], 1, "{said}");
    let saved = site.read("rules/draught.rhai");
    assert!(saved.contains("how draughty"), "nothing was saved: {saved}");
    let left = site
        .path()
        .read_dir()
        .expect("read")
        .flatten()
        .filter(|entry| entry.file_name().to_string_lossy().starts_with("adit-lsp"));
    assert_eq!(left.count(), 0, "nothing is left in the site");
}

#[test]
fn classes_properties_and_words_are_proposed_and_explained() {
    let site = site().built();
    let said = edit(
        &site,
        "rules/draught.rhai",
        r#"
write({ 'rule "how draughty" each room in ROOMS where room.y1 < 4.0 then { room.draught = 1.5; }',
        'rule "new" each door in DOORS some other in ROOMS where other.room == door.room1 then { door. }',
        'rule "newer" each x in ' })
wait("the vocabulary", function() return #problems(0) > 0 end)
said.properties = labels(ask("textDocument/completion", place("door. }", 5)))
said.of_rooms = labels(ask("textDocument/completion", place("other.room", 6)))
said.classes = labels(ask("textDocument/completion", place('"newer" each x in ', 18)))
said.words = labels(ask("textDocument/completion", place('each door in', 0)))
said.property = ask("textDocument/hover", place("y1 <")).result.contents.value
said.class = ask("textDocument/hover", place("DOORS some")).result.contents.value
said.word = ask("textDocument/hover", place("some other")).result.contents.value
"#,
    );
    let has = |list: &str, label: &str| {
        said[list].as_array().is_some_and(|all| all.iter().any(|found| found == label))
    };
    for (list, label) in [
        ("properties", "hardness"),
        ("properties", "room1"),
        ("of_rooms", "draught"),
        ("of_rooms", "x0"),
        ("classes", "ROBOTS"),
        ("classes", "DOORS"),
        ("words", "each"),
        ("words", "known"),
    ] {
        assert!(has(list, label), "{list} proposes {label}: {}", said[list]);
    }
    assert!(!has("properties", "draught"), "of doors nobody says it: {}", said["properties"]);
    let text = |key: &str| said[key].as_str().expect("a text");
    assert!(text("property").contains("**ROOMS.y1**: a number"), "{}", text("property"));
    assert!(text("class").contains("`hardness`"), "{}", text("class"));
    assert!(text("word").contains("if one passes"), "{}", text("word"));
}

#[test]
fn from_a_use_one_comes_to_what_sets_it_and_all_places_take_another_name() {
    let site = site();
    let said = edit(
        &site,
        "rules/draught.rhai",
        r#"
said.set = ask("textDocument/definition", place("room.draught >", 6)).result
said.own = ask("textDocument/definition", place("worse(1.0)", 1)).result
said.shipped = ask("textDocument/references", vim.tbl_extend("force", place("door.hardness", 6), { context = { includeDeclaration = true } })).result
local given = place("room.y1", 6); given.newName = "top"
for _ = 1, 100 do
  said.refused = refusal(ask("textDocument/rename", given))
  if said.refused:find("comes from a table") then break end
  vim.wait(200, function() return false end)
end
local rename = place("room.draught >", 6); rename.newName = "cold"
local edits = ask("textDocument/rename", rename).result
vim.lsp.util.apply_workspace_edit(edits, "utf-16")
for _, buffer in ipairs(vim.api.nvim_list_bufs()) do
  said[vim.fn.fnamemodify(vim.api.nvim_buf_get_name(buffer), ":t")] = table.concat(vim.api.nvim_buf_get_lines(buffer, 0, -1, false), "\n")
end
local taken = place("door.draughty", 6); taken.newName = "hardness"
said.taken = refusal(ask("textDocument/rename", taken))
said.outline = {}
for _, one in ipairs(ask("textDocument/documentSymbol", { textDocument = vim.lsp.util.make_text_document_params() }).result) do table.insert(said.outline, one.name) end
"#,
    );
    assert_eq!(said["set"][0]["range"]["start"]["line"], 2, "{}", said["set"]);
    assert_eq!(said["own"][0]["range"]["start"]["line"], 1, "{}", said["own"]);
    let files: Vec<&str> = said["shipped"]
        .as_array()
        .expect("places")
        .iter()
        .filter_map(|place| place["uri"].as_str())
        .collect();
    assert!(
        files.iter().any(|file| file.contains("adit-lsp-shipped-")),
        "what goes with the program, too: {files:?}"
    );
    let (rules, test) =
        (said["draught.rhai"].as_str().expect("the rules"), said["draught.toml"].as_str().expect("the test"));
    assert!(rules.contains("room.cold = worse(1.0)") && rules.contains("room.cold > 1.0"), "{rules}");
    assert!(rules.contains("rule \"how draughty\"") && rules.contains("door.draughty"), "{rules}");
    assert!(test.contains("{ cold = 1.5 }"), "{test}");
    assert!(
        said["refused"].as_str().is_some_and(|why| why.contains("comes from a table or the map")),
        "{said}"
    );
    assert!(said["taken"].as_str().is_some_and(|why| why.contains("already")), "{said}");
    assert_eq!(
        said["outline"],
        serde_json::json!(["worse", "how draughty", "draughty doors", "draughty doors are hard"])
    );
}

#[test]
fn a_sites_own_files_are_judged_together_with_what_is_not_saved() {
    let site = site();
    let said = edit(
        &site,
        "robots.toml",
        r#"
local lines = vim.api.nvim_buf_get_lines(0, 0, -1, false)
local broken = vim.tbl_map(function(line) return (line:gsub("hardness", "hardnes")) end, lines)
write(broken)
wait("the mistake", function() return #problems(0) > 0 end)
said.wrong = problems(0)
"#,
    );
    let message = said["wrong"][0]["message"].as_str().expect("a message");
    assert!(message.contains("hardnes"), "{message}");
}
