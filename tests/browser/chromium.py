"""A headless Chromium for tests of pages: Debian's, driven by Debian's selenium."""
from selenium import webdriver
from selenium.webdriver.chrome.service import Service


def browser(*flags):
    """Flags are added to the command line of Chromium; logs of the console and of the network are kept."""
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--enable-unsafe-swiftshader", *flags):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
