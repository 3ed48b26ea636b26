@echo off
rem Opens Kulman in the browser. The first time it makes an environment of its own, the folder kulman-env.
setlocal
cd /d "%~dp0..\.."
if exist "kulman-env\ready" goto open
set "FOUND=py -3"
where py >nul 2>nul || set "FOUND=python"
%FOUND% -c "import sys; sys.exit(sys.version_info < (3, 11))" || goto missing
%FOUND% -m venv kulman-env || goto failed
"kulman-env\Scripts\python.exe" -m pip install --disable-pip-version-check ".[docx,note,png,web]" || goto failed
echo ready> "kulman-env\ready"
:open
"kulman-env\Scripts\python.exe" -m kulman serve --open || goto failed
exit /b 0
:missing
echo Python 3.11+: winget install Python.Python.3.13
:failed
pause
exit /b 1
