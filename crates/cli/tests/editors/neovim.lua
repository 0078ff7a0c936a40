-- What somebody does with a wrong model in Neovim, told line by line on standard output.
local function say(...)
  io.stdout:write(table.concat({ ... }, " "):gsub("\n", " ") .. "\n")
end

local function ask(method, at)
  local answers = vim.lsp.buf_request_sync(0, method, at or vim.lsp.util.make_position_params(), 5000)
  for _, answer in pairs(answers or {}) do
    return answer.result
  end
end

-- Goes to where a text stands, so many letters further.
local function go(text, further)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    local column = line:find(text, 1, true)
    if column then
      return vim.api.nvim_win_set_cursor(0, { number, column - 1 + further })
    end
  end
end

local function wrong()
  return #vim.diagnostic.get(0)
end

vim.cmd("edit model.ron")
vim.wait(10000, function() return wrong() > 0 end, 20)
for _, it in ipairs(vim.diagnostic.get(0)) do
  say("wrong", tostring(it.lnum + 1), it.message)
end
go("NLink(", 1)
say("hover", ask("textDocument/hover").contents.value)
go("kq", 0)
local found = ask("textDocument/completion")
for _, it in ipairs(found.items or found) do
  say("completion", it.label)
end
go('use: "', 7)
say("definition", tostring(ask("textDocument/definition").range.start.line + 1))
for _, it in ipairs(ask("textDocument/documentSymbol", { textDocument = vim.lsp.util.make_text_document_params() })) do
  say("outline", it.name)
end
local lines = vim.api.nvim_buf_get_lines(0, 0, -1, false)
for number, line in ipairs(lines) do
  lines[number] = line:gsub("kq:", "kn:")
end
vim.api.nvim_buf_set_lines(0, 0, -1, false, lines)
vim.wait(10000, function() return wrong() == 0 end, 20)
say("left", tostring(wrong()))
vim.cmd("qa!")
